#pragma once
/** @file
Digits of one build that are not described alike: of fingers side by side and of copies about a hub
an axis is the mirror image of the others', or one of three differs from two that agree: its axis
has another direction, a joint turns 1.8 times as far, lies 1.8 times as far from the one before, a
link is 1.8 times as long or three times as heavy. And of a digit that bends by three joints or more
one bends the other way. Reported by the name of the joint or link. */

#include <set>
#include <string>

#include "core/base/diagnostics.h"
#include "core/hand/import/weld_links.h"

namespace graspbench {

/** @returns the joints whose axes were told. @pre the digits are known. */
std::set<int> FindUnlikeDigits(const std::string& file, const ImportedHand& imported,
                               Diagnostics& problems);

}  // namespace graspbench
