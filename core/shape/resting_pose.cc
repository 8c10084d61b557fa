#include "core/shape/resting_pose.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace graspbench {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

/** Vertices up to this height above the lowest one touch [m]: the resolution of single precision.
*/
constexpr double kTouching = 1e-7;
/** A centre of mass this near to the support polygon is above it [m]. */
constexpr double kOver = 1e-9;
/** A smaller rotation than this counts as none [rad]. */
constexpr double kNotTurned = 1e-5;
/** Meshes of a million vertices need some hundred pivots; a tessellated sphere may roll on and on.
*/
constexpr int kMostPivots = 20000;

double Cross(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

/** Returns the corners of the convex hull, counter-clockwise (Andrew's monotone chain). */
std::vector<Vector2d> FindHull(std::vector<Vector2d> points) {
  std::sort(points.begin(), points.end(), [](const Vector2d& a, const Vector2d& b) {
    return a.x() != b.x() ? a.x() < b.x() : a.y() < b.y();
  });
  if (points.size() < 3) return points;
  std::vector<Vector2d> hull;
  for (const bool is_lower : {true, false}) {
    const size_t first = hull.size();
    for (size_t k = 0; k < points.size(); ++k) {
      const Vector2d& p = is_lower ? points[k] : points[points.size() - 1 - k];
      while (hull.size() >= first + 2 &&
             Cross(hull.back() - hull[hull.size() - 2], p - hull.back()) <= 0.0) {
        hull.pop_back();
      }
      hull.push_back(p);
    }
    hull.pop_back();  // the other half begins with it
  }
  return hull;
}

/** Returns the point of the hull that is nearest to `p`; `p` itself when it is inside. */
Vector2d FindNearest(const std::vector<Vector2d>& hull, const Vector2d& p) {
  bool is_inside = hull.size() >= 3;
  Vector2d nearest = hull.front();
  for (size_t k = 0; k < hull.size(); ++k) {
    const Vector2d& a = hull[k];
    const Vector2d edge = hull[(k + 1) % hull.size()] - a;
    is_inside = is_inside && Cross(edge, p - a) >= 0.0;
    const double length = edge.squaredNorm();
    const double share = length > 0.0 ? std::clamp((p - a).dot(edge) / length, 0.0, 1.0) : 0.0;
    const Vector2d candidate = a + share * edge;
    if ((p - candidate).norm() < (p - nearest).norm()) nearest = candidate;
  }
  return is_inside ? p : nearest;
}

}  // namespace

Matrix3d FindRestingRotation(const TriMesh& mesh, const Vector3d& p_OOcm) {
  Matrix3d R_RO = Matrix3d::Identity();
  for (int pivot = 0; pivot < kMostPivots; ++pivot) {
    // Heights and positions are relative to the centre of mass.
    double lowest = std::numeric_limits<double>::infinity();
    const Vector3d up_O = R_RO.row(2);
    for (const Vector3d& p : mesh.vertices) lowest = std::min(lowest, up_O.dot(p - p_OOcm));
    std::vector<Vector2d> touching;
    for (const Vector3d& p : mesh.vertices) {
      if (up_O.dot(p - p_OOcm) > lowest + kTouching) continue;
      touching.push_back((R_RO * (p - p_OOcm)).head<2>());
    }
    const std::vector<Vector2d> hull = FindHull(touching);
    const Vector2d support = FindNearest(hull, Vector2d::Zero());
    const double beside = support.norm();
    if (beside <= kOver && hull.size() >= 3) break;
    // From the support to the centre of mass. When balanced on an edge or a corner, it falls to
    // either side.
    Vector2d towards = -support / beside;
    if (beside <= kOver) {
      const Vector2d along = hull.size() == 2 ? Vector2d(hull[1] - hull[0]) : Vector2d::UnitY();
      towards = Vector2d(along.y(), -along.x()).normalized();
    }
    double angle = std::numeric_limits<double>::infinity();
    for (const Vector3d& p : mesh.vertices) {
      const double height = up_O.dot(p - p_OOcm) - lowest;
      if (height <= kTouching) continue;
      const double distance = towards.dot((R_RO * (p - p_OOcm)).head<2>() - support);
      angle = std::min(angle, std::atan2(height, distance));
    }
    if (!std::isfinite(angle)) break;
    // Lowers the side towards `towards`.
    const Vector3d axis(-towards.y(), towards.x(), 0.0);
    R_RO = Eigen::AngleAxisd(angle, axis).toRotationMatrix() * R_RO;
  }
  if (Eigen::AngleAxisd(R_RO).angle() < kNotTurned) return Matrix3d::Identity();
  return R_RO;
}

void LayDown(GraspObject& object) {
  MassProperties& mass = object.mass_properties;
  const Matrix3d R_RO = FindRestingRotation(object.mesh, mass.p_OOcm);
  if (R_RO == Matrix3d::Identity()) return;
  Eigen::AlignedBox3d box;
  for (Vector3d& p : object.mesh.vertices) {
    p = R_RO * p;
    box.extend(p);
  }
  for (Vector3d& p : object.mesh.vertices) p -= box.center();
  object.size = box.sizes();
  if (object.compressible) {
    object.compressible->yield = R_RO * object.compressible->yield * R_RO.transpose();
  }
  mass.p_OOcm = R_RO * mass.p_OOcm - box.center();
  mass.I_OOcm = R_RO * mass.I_OOcm * R_RO.transpose();
  object.turned_to_rest = Eigen::AngleAxisd(R_RO).angle();
}

}  // namespace graspbench
