#pragma once
/** @file The edges of a mesh and how many triangles run along each, in either direction. */

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

/** Ordered by (from, to). In a closed, consistent mesh both counts are 1 everywhere. */
std::vector<MeshEdge> ListEdges(const TriMesh& mesh);

}  // namespace graspbench
