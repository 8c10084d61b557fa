#pragma once
/** @file
The edges of a mesh, how many triangles run along each in either direction, and which triangles
count as ones without area. */

#include <vector>

#include "core/shape/tri_mesh.h"

namespace graspbench {

/** An edge from its lower to its higher vertex. */
struct MeshEdge {
  int from = -1;
  int to = -1;
  int num_forward = 0;      ///< triangles that run along it from -> to
  int num_backward = 0;     ///< triangles that run along it to -> from
  int first_triangle = -1;  ///< one of them
  int last_triangle = -1;   ///< another one, when there are more
};

/** A triangle whose height against its longest edge is smaller has no area. */
inline constexpr double kMinAspect = 1e-7;

/** Ordered by (from, to). In a closed, consistent mesh both counts are 1 everywhere. */
std::vector<MeshEdge> ListEdges(const TriMesh& mesh);

/** As many triangles in one direction as in the other at every edge? */
bool IsWhole(const std::vector<MeshEdge>& edges);

}  // namespace graspbench
