#include "core/shape/polygon.h"

#include <Eigen/Geometry>
#include <algorithm>

namespace graspbench {
namespace {

constexpr double kRounding = 1e-6;  // of coordinates against the extent

using Points = std::vector<Eigen::Vector2d>;

double CalcTurn(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
  return (b - a).x() * (c - a).y() - (b - a).y() * (c - a).x();
}

// Seen along the polygon's mean normal, so that it runs counter-clockwise.
Points Flatten(const std::vector<int>& corners, const TriMesh& mesh) {
  const Eigen::Vector3d origin = mesh.vertices[corners[0]];
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  for (size_t i = 2; i < corners.size(); ++i) {
    normal += (mesh.vertices[corners[i - 1]] - origin).cross(mesh.vertices[corners[i]] - origin);
  }
  Eigen::Index axis = 0;
  normal.cwiseAbs().maxCoeff(&axis);
  Eigen::Index u = (axis + 1) % 3, v = (axis + 2) % 3;
  if (normal[axis] < 0.0) std::swap(u, v);
  Points points;
  for (const int corner : corners) {
    const Eigen::Vector3d p = mesh.vertices[corner] - origin;
    points.emplace_back(p[u], p[v]);
  }
  return points;
}

// Does the first corner see every edge from the left, but for the rounding of coordinates?
bool IsFan(const Points& points) {
  double extent = 0.0;
  for (const Eigen::Vector2d& p : points) extent = std::max(extent, p.norm());
  for (size_t i = 2; i < points.size(); ++i) {
    const double edge = (points[i] - points[i - 1]).norm();
    if (CalcTurn(points[0], points[i - 1], points[i]) < -kRounding * extent * edge) return false;
  }
  return true;
}

// What is left of a polygon while its ears are cut off.
class Remainder {
 public:
  explicit Remainder(const Points& points) : points_(points) {
    const int count = static_cast<int>(points.size());
    for (int i = 0; i < count; ++i) {
      next_.push_back((i + 1) % count);
      previous_.push_back((i + count - 1) % count);
    }
    for (int i = 0; i < count; ++i) is_ear_.push_back(IsEar(i));
  }

  // (previous, ear, next) as indices into the points. An ear has no other corner inside. A polygon
  // that crosses itself may have none: then the next corner goes.
  Eigen::Vector3i CutEar() {
    const int start = here_;
    while (!is_ear_[here_] && next_[here_] != start) here_ = next_[here_];
    const int before = previous_[here_], after = next_[here_];
    Eigen::Vector3i ear(before, here_, after);
    next_[before] = after;
    previous_[after] = before;
    is_ear_[before] = IsEar(before);
    is_ear_[after] = IsEar(after);
    here_ = after;
    return ear;
  }

 private:
  bool IsEar(int i) const {
    const Eigen::Vector2d &a = points_[previous_[i]], &b = points_[i], &c = points_[next_[i]];
    if (CalcTurn(a, b, c) <= 0.0) return false;
    for (int k = next_[next_[i]]; k != previous_[i]; k = next_[k]) {
      const Eigen::Vector2d& p = points_[k];
      // A corner that lies on one of the ear's own does not block it: two loops joined by a bridge.
      if (p == a || p == b || p == c) continue;
      if (CalcTurn(a, b, p) >= 0.0 && CalcTurn(b, c, p) >= 0.0 && CalcTurn(c, a, p) >= 0.0) {
        return false;
      }
    }
    return true;
  }

  const Points& points_;
  std::vector<int> next_, previous_;
  std::vector<bool> is_ear_;
  int here_ = 0;
};

}  // namespace

bool AppendPolygon(const std::vector<int>& corners, TriMesh& mesh, int64_t& work) {
  const int count = static_cast<int>(corners.size());
  const Points points = Flatten(corners, mesh);
  if (count == 3 || IsFan(points)) {
    for (int i = 2; i < count; ++i) {
      mesh.triangles.emplace_back(corners[0], corners[i - 1], corners[i]);
    }
    return true;
  }
  const int64_t needed = 3 * static_cast<int64_t>(count) * count;
  if (needed > work) return false;
  work -= needed;
  Remainder remainder(points);
  for (int i = 2; i < count; ++i) {
    const Eigen::Vector3i ear = remainder.CutEar();
    mesh.triangles.emplace_back(corners[ear[0]], corners[ear[1]], corners[ear[2]]);
  }
  return true;
}

}  // namespace graspbench
