#include "core/shape/mesh_shells.h"

#include <Eigen/Geometry>
#include <cmath>
#include <map>
#include <numeric>

#include "core/base/units.h"

namespace graspbench {

Shells FindShells(const TriMesh& mesh) {
  // Each triangle points to an earlier one of its shell; the first points to itself.
  std::vector<int> earlier(mesh.triangles.size());
  std::iota(earlier.begin(), earlier.end(), 0);
  const auto find_first = [&](int i) {
    while (earlier[i] != i) i = earlier[i] = earlier[earlier[i]];
    return i;
  };
  std::map<std::pair<int, int>, int> triangle_at;
  for (int i = 0; i < mesh.num_triangles(); ++i) {
    const Eigen::Vector3i& t = mesh.triangles[i];
    for (int k = 0; k < 3; ++k) {
      const std::pair<int, int> edge = std::minmax(t[k], t[(k + 1) % 3]);
      const int other = find_first(triangle_at.emplace(edge, i).first->second);
      const int own = find_first(i);
      earlier[std::max(own, other)] = std::min(own, other);
    }
  }
  Shells shells;
  shells.of_triangle.resize(mesh.triangles.size());
  for (int i = 0; i < mesh.num_triangles(); ++i) {
    const int first = find_first(i);
    shells.of_triangle[i] = first == i ? shells.count++ : shells.of_triangle[first];
  }
  return shells;
}

std::vector<TriMesh> SplitShells(const TriMesh& mesh, const Shells& shells) {
  std::vector<TriMesh> parts(shells.count);
  for (TriMesh& part : parts) part.vertices = mesh.vertices;
  for (int i = 0; i < mesh.num_triangles(); ++i) {
    parts[shells.of_triangle[i]].triangles.push_back(mesh.triangles[i]);
  }
  return parts;
}

int CalcWinding(const TriMesh& mesh, const Eigen::Vector3d& p) {
  double angle = 0.0;
  for (const Eigen::Vector3i& t : mesh.triangles) {
    const Eigen::Vector3d a = mesh.vertices[t[0]] - p, b = mesh.vertices[t[1]] - p,
                          c = mesh.vertices[t[2]] - p;
    const double la = a.norm(), lb = b.norm(), lc = c.norm();
    angle += 2.0 * std::atan2(a.dot(b.cross(c)),
                              la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
  }
  return static_cast<int>(std::lround(angle / (4.0 * kPi)));
}

}  // namespace graspbench
