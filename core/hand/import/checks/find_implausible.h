#pragma once
/** @file
What an imported hand has that the reader can read but no hand has: a bending axis that is the
mirror image of its neighbours' or makes one of several like digits close outwards, a joint that
moves by less than a degree or half a millimetre, less than 10 g in all, a palm of more than 50
times the mass of all digits. Reported, not changed: who made the description knows what was meant.
*/

#include <string>

#include "core/base/diagnostics.h"
#include "core/hand/import/weld_links.h"

namespace graspbench {

/** @pre the digits are known. */
void FindImplausible(const std::string& file, const ImportedHand& imported, Diagnostics& problems);

}  // namespace graspbench
