#pragma once
/** @file
Closed meshes of simple solids, for catalogue objects and for the appearance of hands.

All are lofts: rings of equally many points, connected by quads, with coincident points merged and
degenerate triangles dropped. So a ring may shrink to a point (the pole of a sphere), and the result
is still closed and manifold. Deterministic: the same arguments give the same bits. */

#include <vector>

#include "core/shape/tri_mesh.h"

namespace graspbench {

/** Sphere centred at M's origin, poles on z. `num_segments` around the equator, >= 4. */
TriMesh MakeSphere(double radius, int num_segments = 32);

/** Convex hull of a ball of `radius_A` about A and a ball of `radius_B` about B: a phalanx. If one
ball contains the other, the larger ball alone. */
TriMesh MakeTaperedCapsule(const Eigen::Vector3d& p_MA, double radius_A,
                           const Eigen::Vector3d& p_MB, double radius_B, int num_segments = 24);

/** Box centred at M's origin. Edges and corners are rounded with `edge_radius` in `num_arc` steps
per quarter turn; radius 0 gives a plain box. @pre 2 edge_radius <= every side. */
TriMesh MakeRoundedBox(const Eigen::Vector3d& size, double edge_radius, int num_arc = 4);

/** Revolves the polyline of (radius, z) about the z axis. The solid is to the left of the polyline,
which runs for example bottom centre -> outside -> top centre; radius 0 closes it. */
TriMesh MakeRevolution(const std::vector<Eigen::Vector2d>& profile, int num_segments = 48);

using Ring = std::vector<Eigen::Vector3d>;  ///< points in order, without repeating the first

enum class LoftEnds {
  kCapped,  ///< first and last ring are closed by fans about their centroids
  kJoined,  ///< the last ring joins the first: a torus
};
/** Connects consecutive rings.
@pre rings of equal size, each counter-clockwise seen against the direction of travel. Capped rings
must be star-shaped about their centroid. */
TriMesh MakeLoft(const std::vector<Ring>& rings, LoftEnds ends = LoftEnds::kCapped);

}  // namespace graspbench
