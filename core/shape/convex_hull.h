#pragma once
/** @file
The convex hull of a few thousand points as a closed mesh, by adding one point after another: the
faces that see the point are replaced by those from their rim to it. O(n f) for f faces. */

#include <Eigen/Core>
#include <vector>

#include "core/shape/tri_mesh.h"

namespace graspbench {

/** Faces outwards. Points within 1e-9 of the extent of a face's plane count as on it. Without
triangles when the points lie in a plane. @pre finite points. */
TriMesh MakeConvexHull(const std::vector<Eigen::Vector3d>& points);

}  // namespace graspbench
