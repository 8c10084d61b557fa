#pragma once
/** @file
The convex hull of a few thousand points as a closed mesh, built incrementally: the faces that see a
new point are replaced by faces from their rim to that point. O(n f) for f faces. */

#include <Eigen/Core>
#include <vector>

#include "core/shape/tri_mesh.h"

namespace graspbench {

/** Computes the convex hull, facing outwards. Points within 1e-9 of the extent of a face's plane
count as on it. The result has no triangles if the points are coplanar. @pre finite points. */
TriMesh MakeConvexHull(const std::vector<Eigen::Vector3d>& points);

}  // namespace graspbench
