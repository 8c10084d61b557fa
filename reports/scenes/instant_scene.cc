#include "reports/scenes/instant_scene.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "core/quality/wrench_hull.h"
#include "core/quality/wrench_space.h"
#include "core/shape/primitives.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;

constexpr double kLongestArrow = 0.045;  // [m]
constexpr double kForceLength = 0.04;    // [m/N]
constexpr double kZeroRadius = 0.0012;   // [m]
constexpr double kOnPlane = 1e-7;        // [N]

const Eigen::Vector3f kSpaceColour(0.30f, 0.42f, 0.58f);
const Eigen::Vector3f kZeroColour(0.05f, 0.05f, 0.05f);

/** Lists the corners on a facet's plane, counter-clockwise as seen from outside. */
std::vector<int> ListCorners(const Eigen::Matrix3Xd& points, const Vector3d& normal,
                             double offset) {
  std::vector<int> corners;
  Vector3d middle = Vector3d::Zero();
  for (int i = 0; i < points.cols(); ++i) {
    if (std::abs(normal.dot(points.col(i)) - offset) > kOnPlane) continue;
    corners.push_back(i);
    middle += points.col(i);
  }
  if (corners.empty()) return corners;
  middle /= static_cast<double>(corners.size());
  const Vector3d x = normal.unitOrthogonal(), y = normal.cross(x);
  const auto find_angle = [&](int corner) {
    const Vector3d arm = points.col(corner) - middle;
    return std::atan2(arm.dot(y), arm.dot(x));
  };
  std::sort(corners.begin(), corners.end(),
            [&](int a, int b) { return find_angle(a) < find_angle(b); });
  return corners;
}

/** Whether an earlier facet lies in the same plane. A flat side may consist of several facets; the
first one lists all its corners. */
bool IsKnownPlane(const WrenchHull& hull, Eigen::Index facet) {
  for (Eigen::Index other = 0; other < facet; ++other) {
    const double turn = (hull.normals.col(other) - hull.normals.col(facet)).norm();
    const double apart = std::abs(hull.offsets[other] - hull.offsets[facet]);
    if (turn < kOnPlane && apart < kOnPlane) return true;
  }
  return false;
}

TriMesh MakeSurface(const Eigen::Matrix3Xd& points, const WrenchHull& hull) {
  TriMesh mesh;
  for (int i = 0; i < points.cols(); ++i) mesh.vertices.push_back(kForceLength * points.col(i));
  for (Eigen::Index facet = 0; facet < hull.offsets.size(); ++facet) {
    if (IsKnownPlane(hull, facet)) continue;
    const std::vector<int> corners =
        ListCorners(points, hull.normals.col(facet), hull.offsets[facet]);
    for (size_t c = 2; c < corners.size(); ++c) {
      mesh.triangles.emplace_back(corners[0], corners[c - 1], corners[c]);
    }
  }
  return mesh;
}

Drawable MakeDrawable(TriMesh mesh, const Eigen::Vector3f& colour) {
  Drawable drawable;
  drawable.mesh = std::make_shared<const TriMesh>(std::move(mesh));
  drawable.colour = colour;
  drawable.crease_angle = 0.3;
  return drawable;
}

}  // namespace

std::vector<ContactMark> MakeContactMarks(const TraceInstant& instant) {
  std::vector<ContactMark> marks;
  for (const HandContact& contact : instant.contacts) {
    marks.push_back({contact.p_WC, contact.nhat_W,
                     contact.normal_force * contact.nhat_W + contact.friction_W, contact.mu,
                     IsSliding(contact)});
  }
  return marks;
}

double FindArrowScale(const TracedTrial& traced) {
  double largest = 0.0;
  for (const TraceInstant& instant : traced.trace) {
    for (const HandContact& contact : instant.contacts) {
      largest = std::max(largest, std::hypot(contact.normal_force, contact.friction_W.norm()));
    }
  }
  return largest > 0.0 ? kLongestArrow / largest : 0.0;
}

std::optional<Scene> MakeForceSpaceScene(const std::vector<HandContact>& contacts) {
  std::vector<GraspContact> grasp;
  for (const HandContact& contact : contacts) {
    grasp.push_back({contact.p_WC, contact.nhat_W, contact.mu, 0.0, std::nullopt});
  }
  const Eigen::Matrix3Xd forces = CalcConeWrenches(grasp, {}).wrenches.topRows<3>();
  Eigen::Matrix3Xd points(3, forces.cols() + 1);
  points << forces, Vector3d::Zero();
  if (points.cols() < 5) return std::nullopt;
  const WrenchHull hull = CalcWrenchHull(points);
  if (hull.is_flat) return std::nullopt;
  Scene scene;
  scene.has_table = false;
  scene.drawables.push_back(MakeDrawable(MakeSurface(points, hull), kSpaceColour));
  scene.drawables.push_back(MakeDrawable(MakeSphere(kZeroRadius, 16), kZeroColour));
  scene.drawables.back().is_mark = true;
  return scene;
}

}  // namespace graspbench
