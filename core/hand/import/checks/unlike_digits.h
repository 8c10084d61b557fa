#pragma once
/** @file
Digits of one build that are not described alike. Of fingers side by side and of copies about a hub
an axis is the mirror image of the others'. Of three in a row one differs from two that agree: its
axis by more than 37 degrees; it stands 30 mm off their row; a joint turns or lies 1.8 times as far,
has a fifth of their effort or five times as much, follows another by a third or three times as
much; a link is 1.8 times as long or three times as heavy. Of three copies, wherever they stand, one
joint turns about another axis of its frame. And of a digit that bends by three joints or more one
bends the other way. Reported by the name of the joint or link. */

#include <set>
#include <string>

#include "core/base/diagnostics.h"
#include "core/hand/import/weld_links.h"

namespace graspbench {

/** @returns the joints whose axes were told. @pre the digits are known. */
std::set<int> FindUnlikeDigits(const std::string& file, const ImportedHand& imported,
                               Diagnostics& problems);

}  // namespace graspbench
