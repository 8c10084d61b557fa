#include "core/hand/tactile.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/base/units.h"
#include "core/hand/hand.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;

constexpr double kPointSpacing = 0.0007;  // [m]

int CountSteps(double length) {
  return std::max(1, static_cast<int>(std::ceil(length / kPointSpacing)));
}

Vector3d FindNearestOnAxis(const LinkCapsule& capsule, const Vector3d& p) {
  const Vector3d axis = capsule.p_LB - capsule.p_LA;
  const double square = axis.squaredNorm();
  const double share =
      square > 0.0 ? std::clamp((p - capsule.p_LA).dot(axis) / square, 0.0, 1.0) : 0.0;
  return capsule.p_LA + share * axis;
}

double CalcDistance(const LinkCapsule& capsule, const Vector3d& p) {
  return (p - FindNearestOnAxis(capsule, p)).norm() - capsule.radius;
}

/** Of one capsule: rings along its axis, and of both its ends. */
std::vector<SurfacePoint> SampleCapsule(const LinkCapsule& capsule) {
  const Vector3d span = capsule.p_LB - capsule.p_LA;
  const double r = capsule.radius, length = span.norm();
  const Eigen::Matrix3d frame =
      Eigen::Quaterniond::FromTwoVectors(Vector3d::UnitZ(),
                                         length > 0.0 ? Vector3d(span / length) : Vector3d::UnitZ())
          .toRotationMatrix();
  std::vector<SurfacePoint> points;
  const auto add_ring = [&](double height, double elevation, double ring_area) {
    const int count = CountSteps(2.0 * kPi * r * std::cos(elevation));
    for (int i = 0; i < count; ++i) {
      const double turn = 2.0 * kPi * (i + 0.5) / count;
      SurfacePoint point;
      point.normal_L = frame * Vector3d(std::cos(elevation) * std::cos(turn),
                                        std::cos(elevation) * std::sin(turn), std::sin(elevation));
      point.p_L = capsule.p_LA + frame * Vector3d(0.0, 0.0, height) + r * point.normal_L;
      point.area = ring_area / count;
      points.push_back(point);
    }
  };
  const int num_rings = CountSteps(length), num_caps = CountSteps(0.5 * kPi * r);
  for (int i = 0; length > 0.0 && i < num_rings; ++i) {
    add_ring(length * (i + 0.5) / num_rings, 0.0, 2.0 * kPi * r * length / num_rings);
  }
  for (int i = 0; i < num_caps; ++i) {
    const double low = 0.5 * kPi * i / num_caps, high = 0.5 * kPi * (i + 1) / num_caps;
    const double area = 2.0 * kPi * r * r * (std::sin(high) - std::sin(low));
    add_ring(length, 0.5 * (low + high), area);
    add_ring(0.0, -0.5 * (low + high), area);
  }
  return points;
}

}  // namespace

const SensedSurface* TactileSkin::FindSurface(int link) const {
  for (const SensedSurface& surface : surfaces) {
    if (surface.part.link == link) return &surface;
  }
  return nullptr;
}

std::vector<SurfacePoint> SampleSurface(const Hand& hand, const SensedPart& part) {
  std::vector<SurfacePoint> points;
  for (const LinkCapsule& capsule : hand.capsules) {
    if (capsule.link != part.link) continue;
    for (const SurfacePoint& point : SampleCapsule(capsule)) {
      const bool is_inside =
          std::any_of(hand.capsules.begin(), hand.capsules.end(), [&](const LinkCapsule& other) {
            return &other != &capsule && other.link == part.link &&
                   CalcDistance(other, point.p_L) < -1e-9;
          });
      const bool faces = part.palmar.isZero() || point.normal_L.dot(part.palmar) > 1e-9;
      const bool lies_beyond = part.along.isZero() || point.p_L.dot(part.along) >= part.from;
      if (!is_inside && faces && lies_beyond) points.push_back(point);
    }
  }
  return points;
}

void AssignElements(const std::vector<TactileElement>& elements, SensedSurface& surface) {
  for (SurfacePoint& point : surface.points) {
    double nearest = std::numeric_limits<double>::infinity();
    for (size_t i = 0; i < elements.size(); ++i) {
      const double distance = (elements[i].p_LE - point.p_L).squaredNorm();
      if (elements[i].link != surface.part.link || distance >= nearest) continue;
      nearest = distance;
      point.element = static_cast<int>(i);
    }
  }
}

Vector3d ProjectOntoSurface(const Hand& hand, int link, const Vector3d& p_L) {
  const LinkCapsule* nearest = nullptr;
  for (const LinkCapsule& capsule : hand.capsules) {
    if (capsule.link != link) continue;
    if (!nearest || CalcDistance(capsule, p_L) < CalcDistance(*nearest, p_L)) nearest = &capsule;
  }
  GRASPBENCH_DEMAND(nearest != nullptr, "link " + std::to_string(link) + " has no contact");
  const Vector3d on_axis = FindNearestOnAxis(*nearest, p_L);
  const Vector3d away = p_L - on_axis;
  if (away.isZero(1e-9)) return p_L;
  return on_axis + nearest->radius * away.normalized();
}

}  // namespace graspbench
