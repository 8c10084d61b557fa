#pragma once
/** @file
What an imported hand has that the reader can read but no hand has: a bending axis that is the
mirror image of its neighbours' or makes one of several like digits close outwards, a digit that
closes away from all others, jaws that run the same way, a joint that moves by less than a degree or
half a millimetre, by more than 3.6 rad, or 1.8 times as far as like joints beside it, a longest
digit outside 30 to 250 mm, less than 10 g in all, less than 200 or more than 12,000 kg by cubic
metre of its shapes, a palm of more than 50 times the mass of all digits. Reported, not changed: who
made the description knows what was meant. */

#include <string>

#include "core/base/diagnostics.h"
#include "core/hand/import/weld_links.h"

namespace graspbench {

/** @pre the digits are known. */
void FindImplausible(const std::string& file, const ImportedHand& imported, Diagnostics& problems);

}  // namespace graspbench
