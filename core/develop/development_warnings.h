#pragma once
/** @file
What a user should know before relying on a developed grasp. */

#include <string>
#include <vector>

#include "core/develop/develop_grasp.h"

namespace graspbench {

/** Sentences without the grasp's name; empty: nothing. A warning says that

    - more than 1 % of the trials failed numerically, which counts as not held;
    - less than a tenth of the check's shapes was held;
    - two digits held less than half of them and cannot oppose (digit_opposition.h).

The limits are proposed by graspbench. */
std::vector<std::string> ListDevelopmentWarnings(const Hand& hand, const DevelopedGrasp& developed);

}  // namespace graspbench
