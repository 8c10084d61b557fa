#pragma once
/** @file
What the links of an imported hand touch with: packed balls for objects and the table
(CollisionShape::is_cover), inscribed capsules for the hand itself (is_self_contact). */

#include <string>

#include "core/base/error.h"
#include "core/hand/import/weld_links.h"
#include "core/hand/link_solid.h"

namespace graspbench {

/** Packs balls into every link with a solid (pack_balls.h) where its spheres, capsules and boxes do
not reach its surface; what stood for meshes and discs is replaced. A hand without a picture whose
meshes touch is drawn as these meshes. @param num_points  on a link.
@pre the digits are known. */
void CoverLinks(const LinkSolids& solids, int num_points, ImportedHand& imported);

/** Measures what the links touch with against their solids (contact_fit.h) into `imported.fits`. A
warning above 1 mm; above 5 mm on the palmar side or a tip an error, a warning where
`accepts_coarse`. */
void MeasureLinks(const std::string& file, bool accepts_coarse, const LinkSolids& solids,
                  ImportedHand& imported, Diagnostics& problems);

/** Frees joints at the palm that their own contact shapes would block: a finger's first link that
sits in the palm's housing meets it, as balls and capsules, within the limits that the description
gives the joint. The limits are the description's, the shapes an approximation; so a link whose
joint is at the root of its digit (25 mm at most from the digit's first joint) and whose shapes
enter the palm's by more than half a millimetre never counts as touching the palm (Hand::apart), and
that is reported. It keeps all of its shapes: objects and other digits still meet them.

@pre the digits are known. */
void FreeJoints(const std::string& file, ImportedHand& imported, Diagnostics& problems);

}  // namespace graspbench
