#pragma once
/** @file
Contact geometry of the links of an imported hand: packed balls for contact with objects and table
(CollisionShape::is_cover), inscribed capsules for contact with the hand itself
(is_self_contact). */

#include <string>

#include "core/base/error.h"
#include "core/hand/import/weld_links.h"
#include "core/hand/link_solid.h"

namespace graspbench {

/** Packs balls into every link with a solid (pack_balls.h) where its spheres, capsules and boxes do
not reach its surface. Shapes that stood for meshes and discs are replaced. A hand without visuals
but with collision meshes is drawn with these meshes. @param num_points  points per link.
@pre the digits are known. */
void CoverLinks(const LinkSolids& solids, int num_points, ImportedHand& imported);

/** Measures the contact geometry of the links against their solids (contact_fit.h) into
`imported.fits`. An error above 1 mm gives a warning. Above 5 mm on the palmar side or at a tip the
import fails, unless `accepts_coarse`. */
void MeasureLinks(const std::string& file, bool accepts_coarse, const LinkSolids& solids,
                  ImportedHand& imported, Diagnostics& problems);

/** Frees joints at the palm that their own contact shapes would block. The first link of a finger
often sits in the palm's housing, so that its balls and capsules meet the palm's within the joint
limits of the description. These limits are the description's, while the shapes are approximations.
Therefore a link that enters the palm's shapes by more than 0.5 mm never counts as touching the palm
(Hand::apart), which is reported. Its joint must be within 25 mm of the digit's first joint. Objects
and other digits still touch all of its shapes.

@pre the digits are known. */
void FreeJoints(const std::string& file, ImportedHand& imported, Diagnostics& problems);

}  // namespace graspbench
