#pragma once
/** @file
The robustness basin of one grasp as a page: a map of offsets in slices of yaw, and its radius. */

#include <string>
#include <vector>

#include "core/trial/basin.h"

namespace graspbench {

/** A self-contained page like the session's report. `title` names hand, object and grasp. */
std::string MakeBasinPage(const std::string& title, const std::vector<BasinSample>& samples);

}  // namespace graspbench
