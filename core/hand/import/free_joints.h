#pragma once
/** @file
Frees joints at the palm that their own contact shapes would block: a finger's first link that sits
in the palm's housing meets it, as balls and capsules, within the limits that the description gives
the joint. The limits are the description's, the shapes an approximation; so the shapes of that link
which meet the palm by more than half a millimetre are left out of contact, and told. A link that
would lose all of them is cut along their length instead, and keeps the pieces that do not meet the
palm. A link that carries its digit's pad, as the jaw of a gripper does, keeps all of its shapes. */

#include <string>

#include "core/base/diagnostics.h"
#include "core/hand/import/weld_links.h"

namespace graspbench {

/** @pre the digits are known. */
void FreeJoints(const std::string& file, ImportedHand& imported, Diagnostics& problems);

}  // namespace graspbench
