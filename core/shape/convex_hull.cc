#include "core/shape/convex_hull.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <set>
#include <utility>

namespace graspbench {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3i;

/** Finds four points that span a volume; the first index is -1 when there are none. */
std::array<int, 4> FindFirstCorners(const std::vector<Vector3d>& points, double tolerance) {
  const auto find_farthest = [&](auto&& measure) {
    int farthest = -1;
    double most = tolerance;
    for (size_t i = 0; i < points.size(); ++i) {
      if (measure(points[i]) <= most) continue;
      most = measure(points[i]);
      farthest = static_cast<int>(i);
    }
    return farthest;
  };
  const Vector3d a = points[0];
  const int b = find_farthest([&](const Vector3d& p) { return (p - a).norm(); });
  if (b < 0) return {-1};
  const Vector3d along = (points[b] - a).normalized();
  const int c = find_farthest([&](const Vector3d& p) { return along.cross(p - a).norm(); });
  if (c < 0) return {-1};
  const Vector3d normal = along.cross(points[c] - a).normalized();
  const int d = find_farthest([&](const Vector3d& p) { return std::abs(normal.dot(p - a)); });
  if (d < 0) return {-1};
  const bool is_above = normal.dot(points[d] - a) > 0.0;
  return is_above ? std::array<int, 4>{0, c, b, d} : std::array<int, 4>{0, b, c, d};
}

}  // namespace

TriMesh MakeConvexHull(const std::vector<Vector3d>& points) {
  if (points.size() < 4) return {};
  Eigen::AlignedBox3d box;
  for (const Vector3d& p : points) box.extend(p);
  const double tolerance = 1e-9 * box.sizes().maxCoeff();
  const std::array<int, 4> first = FindFirstCorners(points, tolerance);
  if (first[0] < 0) return {};
  const auto [a, b, c, d] = first;
  std::vector<Vector3i> faces = {{a, b, c}, {a, d, b}, {b, d, c}, {c, d, a}};
  const auto sees = [&](const Vector3d& p, const Vector3i& face) {
    const Vector3d& corner = points[face[0]];
    const Vector3d normal = (points[face[1]] - corner).cross(points[face[2]] - corner);
    return normal.dot(p - corner) > tolerance * normal.norm();
  };
  for (size_t i = 0; i < points.size(); ++i) {
    const auto seen = std::stable_partition(
        faces.begin(), faces.end(), [&](const Vector3i& face) { return !sees(points[i], face); });
    std::set<std::pair<int, int>> edges;
    for (auto face = seen; face != faces.end(); ++face) {
      for (int k = 0; k < 3; ++k) edges.emplace((*face)[k], (*face)[(k + 1) % 3]);
    }
    faces.erase(seen, faces.end());
    for (const auto& [from, to] : edges) {
      if (edges.count({to, from}) == 0) faces.emplace_back(from, to, static_cast<int>(i));
    }
  }
  TriMesh hull;
  std::vector<int> corner_of(points.size(), -1);
  for (Vector3i face : faces) {
    for (int& corner : face) {
      if (corner_of[corner] < 0) {
        corner_of[corner] = hull.num_vertices();
        hull.vertices.push_back(points[corner]);
      }
      corner = corner_of[corner];
    }
    hull.triangles.push_back(face);
  }
  return hull;
}

}  // namespace graspbench
