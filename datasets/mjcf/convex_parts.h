#pragma once
/** @file
Decomposes a solid into convex parts, for engines that support only convex shapes.

The mesh is cut repeatedly by axis-aligned planes, where the convex hull of a part protrudes
farthest from the solid, until it protrudes by at most a tolerance. The parts cover the solid
(except slivers thinner than 0.1 mm) and protrude from it by at most `excess`: a groove or dimple
shallower than the tolerance is bridged, and a round hole becomes polygonal.

As in approximate convex decomposition (Lien and Amato 2007), the depth of a notch, not its volume,
determines where to cut. */

#include <set>
#include <utility>
#include <vector>

#include "core/hand/hand.h"
#include "core/shape/signed_distance_field.h"
#include "core/shape/tri_mesh.h"

namespace graspbench {

struct ConvexPart {
  std::vector<Eigen::Vector3d> vertices;  ///< of its convex hull, in the mesh's frame [m]
  double excess = 0.0;  ///< protrusion of its hull, sampled in the distance field [m]
};

struct ConvexPartsConfig {
  double tolerance = 0.001;  ///< on the excess [m]
  int max_parts = 200;       ///< limit; remaining parts stay uncut, with their excess
};

/** Decomposes the mesh; deterministic, takes up to some seconds. @pre the mesh is closed, and
`field` is its distance field. */
std::vector<ConvexPart> CutIntoConvexParts(const TriMesh& mesh, const SignedDistanceField& field,
                                           const ConvexPartsConfig& config = {});

/** Finds pairs of links that touch by design, so that their contact is ignored. The links, smaller
index first, belong to different digits or to a digit and the palm, and their capsules touch with
all joints at zero. Balls along one axis, a 64th of its length apart, are tested against the other
axis. */
std::set<std::pair<int, int>> FindLinksTouchingAtRest(const Hand& hand);

}  // namespace graspbench
