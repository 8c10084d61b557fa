#pragma once
/** @file
A solid as a union of convex parts, for engines that know convex shapes only.

The mesh is cut by planes across its axes repeatedly, where the convex hull of a part reaches
farthest out of the solid, until it reaches out by no more than a tolerance. The parts fill the
solid (nothing of it is lost but slivers thinner than 0.1 mm) and stick out of it by at most
`excess`: a groove or dimple shallower than the tolerance is bridged, a round hole becomes a
polygon's.

The idea is that of approximate convex decomposition (Lien and Amato 2007): the depth of the notch,
not the volume, says where to cut. */

#include <set>
#include <utility>
#include <vector>

#include "core/hand/hand.h"
#include "core/shape/signed_distance_field.h"
#include "core/shape/tri_mesh.h"

namespace graspbench {

struct ConvexPart {
  std::vector<Eigen::Vector3d> vertices;  ///< of its hull, in the mesh's frame [m]
  double excess = 0.0;  ///< how far its hull reaches out, as sampled in the field [m]
};

struct ConvexPartsConfig {
  double tolerance = 0.001;  ///< of the excess [m]
  int max_parts = 200;       ///< what is left then stays uncut, and its excess says so
};

/** The same arguments give the same bits. @pre the mesh is closed, `field` is its own. Costs up to
some seconds. */
std::vector<ConvexPart> CutIntoConvexParts(const TriMesh& mesh, const SignedDistanceField& field,
                                           const ConvexPartsConfig& config = {});

/** Which links of a hand are built so that they touch, and are therefore no contact.

Pairs of links, the smaller index first, of different digits or of a digit and the palm, whose
capsules touch with all joints at zero: balls along the axis of one against the axis of the other, a
64th of its length apart. */
std::set<std::pair<int, int>> FindLinksTouchingAtRest(const Hand& hand);

}  // namespace graspbench
