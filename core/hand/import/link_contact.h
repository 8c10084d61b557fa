#pragma once
/** @file
Covers every link of a digit: what its contact shapes leave out of the description's surface gets
balls of its own (cover_surface.h), which objects and the table meet (CollisionShape::is_cover). */

#include <string>

#include "core/base/error.h"
#include "core/hand/import/weld_links.h"

namespace graspbench {

/** Notes how much was added, and warns of a link of which more than 1.5 mm stays uncovered at 95 of
100 points. @param num_points  on a link. @pre the digits are known. */
void CoverLinks(const std::string& file, int num_points, ImportedHand& imported,
                Diagnostics& problems);

/** Frees joints at the palm that their own contact shapes would block: a finger's first link that
sits in the palm's housing meets it, as balls and capsules, within the limits that the description
gives the joint. The limits are the description's, the shapes an approximation; so a link whose
joint is at the root of its digit (25 mm at most from the digit's first joint) and whose shapes
enter the palm's by more than half a millimetre never counts as touching the palm (Hand::apart), and
that is reported. It keeps all of its shapes: objects and other digits still meet them.

@pre the digits are known. */
void FreeJoints(const std::string& file, ImportedHand& imported, Diagnostics& problems);

}  // namespace graspbench
