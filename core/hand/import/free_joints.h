#pragma once
/** @file
Frees joints at the palm that their own contact shapes would block: a finger's first link that sits
in the palm's housing meets it, as balls and capsules, within the limits that the description gives
the joint. The limits are the description's, the shapes an approximation; so a link whose joint is
at the root of its digit (25 mm at most from the digit's first joint) and whose shapes enter the
palm's by more than half a millimetre never counts as touching the palm (Hand::apart), and that is
reported. It keeps all of its shapes: objects and other digits still meet them. */

#include <string>

#include "core/base/diagnostics.h"
#include "core/hand/import/weld_links.h"

namespace graspbench {

/** @pre the digits are known. */
void FreeJoints(const std::string& file, ImportedHand& imported, Diagnostics& problems);

}  // namespace graspbench
