#pragma once
/** @file
What an imported hand has that the reader can read but no hand has: what unlike_digits.h,
misplaced_links.h, outward_digits.h and opposed_digits.h find; jaws that run the same way; a joint
that moves by less than a degree or half a millimetre or by more than 3.6 rad, or follows a joint of
another digit behind one with a drive of its own; a longest digit outside 30 to 250 mm, less than
10 g in all, less than 200 or more than 12,000 kg by cubic metre of its shapes, a palm of more than
50 times the mass of all digits. Reported, not changed: who made the description knows what was
meant. */

#include <string>

#include "core/base/diagnostics.h"
#include "core/hand/import/weld_links.h"

namespace graspbench {

/** @pre the digits are known. */
void FindImplausible(const std::string& file, const ImportedHand& imported, Diagnostics& problems);

}  // namespace graspbench
