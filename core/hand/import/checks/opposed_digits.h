#pragma once
/** @file
Whether digits can hold something between them: pads that face each other, near enough, with no palm
between. */

#include <vector>

#include "core/hand/import/weld_links.h"

namespace graspbench {

/** By digit: it opposes another one. Over postures that close both to any share, and others that
move all their joints, the line between the two pads leaves each by 70 degrees from its normal at
most, is free of the palm, and is 40 mm long at most, or half as long as at the open hand; or their
last links come together by closing. Fingers side by side that bend the same way oppose no other of
them. A digit without shapes has no pad that faces anywhere, and is not doubted.
@pre digits with tips and pads. */
std::vector<bool> FindOpposedDigits(const ImportedHand& imported);

}  // namespace graspbench
