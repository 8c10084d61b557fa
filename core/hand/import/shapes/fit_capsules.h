#pragma once
/** @file
Fits balls and capsules to a mesh for the checks of an import: volume, bounds, positions. The
contact geometry of the hand is fitted in pack_balls.h.

The mesh need not be closed: on a grid of cells, everything that a flood from outside does not reach
is solid. The solid is split in two repeatedly, along one of the principal axes of the piece that
fits worst. Each piece gets the least-squares capsule,

    min over A, B, r of  sum over the outer surface's points p of (|p - AB| - r)^2,

where |p - AB| is the distance to the segment. The points p are those of the piece, and those of
other pieces out of which the capsule sticks. It ends when the fit reaches the tolerance or the
largest number of capsules. The reported error is measured at points of the mesh's outer surface
against the union of the capsules, so gaps between capsules count. */

#include <Eigen/Core>
#include <vector>

#include "core/hand/contact_shape.h"
#include "core/shape/tri_mesh.h"

namespace graspbench {

struct FittedCapsule {
  Eigen::Vector3d p_A = Eigen::Vector3d::Zero();  ///< ends of the axis, equal for a ball [m]
  Eigen::Vector3d p_B = Eigen::Vector3d::Zero();
  double radius = 0.0;  ///< [m]
};

struct CapsuleFit {
  std::vector<FittedCapsule> capsules;
  double rms_error = 0.0;      ///< of the distance of the outer surface from the capsules [m]
  double largest_error = 0.0;  ///< 95th percentile of this distance [m]
};

/** @param tolerance  the fit ends when 19 of 20 points are within this distance [m].
@pre the mesh has a triangle, valid indices and finite vertices within 10 m. Takes up to some
seconds for a million triangles. */
CapsuleFit FitCapsules(const TriMesh& mesh, double tolerance, int most_capsules);

/** Returns a cylinder between the capsule's round ends, or a ball, with link -1. */
CollisionShape MakeCapsuleShape(const FittedCapsule& capsule);

}  // namespace graspbench
