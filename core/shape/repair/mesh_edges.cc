#include "core/shape/repair/mesh_edges.h"

#include <algorithm>
#include <tuple>

namespace graspbench {

std::vector<MeshEdge> ListEdges(const TriMesh& mesh) {
  std::vector<MeshEdge> sides;
  for (int i = 0; i < mesh.num_triangles(); ++i) {
    const Eigen::Vector3i& t = mesh.triangles[i];
    for (int k = 0; k < 3; ++k) {
      const int a = t[k], b = t[(k + 1) % 3];
      sides.push_back({std::min(a, b), std::max(a, b), a < b ? 1 : 0, a < b ? 0 : 1, i, i});
    }
  }
  std::sort(sides.begin(), sides.end(), [](const MeshEdge& a, const MeshEdge& b) {
    return std::tie(a.from, a.to, a.first_triangle) < std::tie(b.from, b.to, b.first_triangle);
  });
  std::vector<MeshEdge> edges;
  for (const MeshEdge& side : sides) {
    if (edges.empty() || edges.back().from != side.from || edges.back().to != side.to) {
      edges.push_back(side);
      continue;
    }
    edges.back().num_forward += side.num_forward;
    edges.back().num_backward += side.num_backward;
    edges.back().last_triangle = side.last_triangle;
  }
  return edges;
}

bool IsWhole(const std::vector<MeshEdge>& edges) {
  return std::all_of(edges.begin(), edges.end(),
                     [](const MeshEdge& edge) { return edge.num_forward == edge.num_backward; });
}

}  // namespace graspbench
