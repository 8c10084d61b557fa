#pragma once
/** @file
Balls and capsules in the place of a mesh, for the checks of an import: volume, bounds, places. What
the hand touches with is fitted in pack_balls.h.

The mesh need not be closed: what a flood from outside does not reach, on a grid of cells, is solid.
The solid is cut in two repeatedly, along one of the principal axes of the piece that fits
worst; each piece gets the capsule of least squares,

    min over A, B, r of  sum over the outer surface's points p of (|p - AB| - r)^2,

p those of the piece and those of others that the capsule sticks out of, |p - AB| the distance to
the segment. It ends when the fit is as near as asked or has as many
capsules as allowed. The error that is told is measured on points of the mesh's outer surface
against the union of the capsules, so a gap between two of them counts. */

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
  double rms_error = 0.0;      ///< of the outer surface's distance from the capsules [m]
  double largest_error = 0.0;  ///< exceeded by one point in twenty [m]
};

/** @param tolerance  enough when 19 of 20 points are as near [m].
@pre the mesh has a triangle, valid indices and finite vertices within 10 m. Up to some seconds for
a million triangles. */
CapsuleFit FitCapsules(const TriMesh& mesh, double tolerance, int most_capsules);

/** A cylinder between its round ends, or a ball, of link -1. */
CollisionShape MakeCapsuleShape(const FittedCapsule& capsule);

}  // namespace graspbench
