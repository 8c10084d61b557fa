#include "core/shape/repair/mesh_shells.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

#include "core/base/units.h"

namespace graspbench {

namespace {

constexpr int kNumSamples = 12;

// Numbers that are joined to sets, each known by its least member.
class JoinedSets {
 public:
  explicit JoinedSets(int count) : earlier_(count) {
    std::iota(earlier_.begin(), earlier_.end(), 0);
  }
  int FindFirst(int i) {
    while (earlier_[i] != i) i = earlier_[i] = earlier_[earlier_[i]];
    return i;
  }
  void Join(int i, int j) {
    i = FindFirst(i);
    j = FindFirst(j);
    earlier_[std::max(i, j)] = std::min(i, j);
  }

 private:
  std::vector<int> earlier_;
};

// The sides of triangles at one edge: the triangle, and +1 or -1 for its direction.
using Sides = std::vector<std::pair<int, int>>;

}  // namespace

Shells FindShells(const TriMesh& mesh) {
  JoinedSets sets(mesh.num_triangles());
  std::map<std::pair<int, int>, Sides> sides_at;
  for (int i = 0; i < mesh.num_triangles(); ++i) {
    const Eigen::Vector3i& t = mesh.triangles[i];
    for (int k = 0; k < 3; ++k) {
      const int a = t[k], b = t[(k + 1) % 3];
      sides_at[std::minmax(a, b)].emplace_back(i, a < b ? 1 : -1);
    }
  }
  for (const auto& [edge, sides] : sides_at) {
    if (sides.size() == 2) sets.Join(sides[0].first, sides[1].first);
  }
  for (const auto& [edge, sides] : sides_at) {
    if (sides.size() <= 2) continue;
    std::map<int, int> excess;  // by set: more one way than the other
    for (const auto& [triangle, direction] : sides) excess[sets.FindFirst(triangle)] += direction;
    int first = -1;
    for (const auto& [set, count] : excess) {
      if (count == 0) continue;
      if (first >= 0) sets.Join(first, set);
      first = set;
    }
  }
  Shells shells;
  shells.of_triangle.resize(mesh.triangles.size());
  for (int i = 0; i < mesh.num_triangles(); ++i) {
    const int first = sets.FindFirst(i);
    shells.of_triangle[i] = first == i ? shells.count++ : shells.of_triangle[first];
  }
  return shells;
}

std::vector<TriMesh> SplitShells(const TriMesh& mesh, const Shells& shells) {
  std::vector<TriMesh> parts(shells.count);
  for (int i = 0; i < mesh.num_triangles(); ++i) {
    parts[shells.of_triangle[i]].triangles.push_back(mesh.triangles[i]);
  }
  for (TriMesh& part : parts) {
    std::map<int, int> kept;
    for (Eigen::Vector3i& t : part.triangles) {
      for (int& corner : t) {
        const auto [place, is_new] = kept.emplace(corner, part.num_vertices());
        if (is_new) part.vertices.push_back(mesh.vertices[corner]);
        corner = place->second;
      }
    }
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

std::vector<Eigen::Vector3d> SampleSurface(const TriMesh& mesh) {
  std::vector<Eigen::Vector3d> points;
  const int step = std::max(1, mesh.num_triangles() / kNumSamples);
  for (int i = 0; i < mesh.num_triangles(); i += step) {
    const Eigen::Vector3i& t = mesh.triangles[i];
    points.emplace_back(0.5 * mesh.vertices[t[0]] + 0.3 * mesh.vertices[t[1]] +
                        0.2 * mesh.vertices[t[2]]);
  }
  return points;
}

}  // namespace graspbench
