#include "core/hand/contact_shape.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "core/base/units.h"

namespace graspbench {

using Eigen::Vector3d;

ClosestPoints FindClosestPoints(const Vector3d& a0, const Vector3d& a1, const Vector3d& b0,
                                const Vector3d& b1) {
  const Vector3d da = a1 - a0, db = b1 - b0, r = a0 - b0;
  const double aa = da.squaredNorm(), bb = db.squaredNorm(), br = db.dot(r);
  constexpr double kPoint = 1e-18;
  double s = 0.0, t = 0.0;
  if (aa <= kPoint) {
    t = bb <= kPoint ? 0.0 : std::clamp(br / bb, 0.0, 1.0);
  } else {
    const double ar = da.dot(r);
    if (bb <= kPoint) {
      s = std::clamp(-ar / aa, 0.0, 1.0);
    } else {
      const double ab = da.dot(db), denominator = aa * bb - ab * ab;
      s = denominator > kPoint ? std::clamp((ab * br - ar * bb) / denominator, 0.0, 1.0) : 0.0;
      t = (ab * s + br) / bb;
      if (t < 0.0 || t > 1.0) {
        t = std::clamp(t, 0.0, 1.0);
        s = std::clamp((ab * t - ar) / aa, 0.0, 1.0);
      }
    }
  }
  return {a0 + s * da, b0 + t * db};
}

Vector3d FindNearestOnAxis(const LinkCapsule& capsule, const Vector3d& p) {
  const Vector3d axis = capsule.p_LB - capsule.p_LA;
  const double square = axis.squaredNorm();
  const double share =
      square > 0.0 ? std::clamp((p - capsule.p_LA).dot(axis) / square, 0.0, 1.0) : 0.0;
  return capsule.p_LA + share * axis;
}

double CalcDistanceToCapsule(const LinkCapsule& capsule, const Vector3d& p) {
  return (p - FindNearestOnAxis(capsule, p)).norm() - capsule.radius;
}

std::vector<CapsulePair> FindCapsulePairs(const Hand& hand) {
  const std::vector<Pose> X_HL = CalcLinkPoses(hand, Eigen::VectorXd::Zero(hand.num_joints()));
  const std::vector<LinkCapsule>& capsules = hand.capsules;
  const auto are_apart = [&](int link, int other) {
    return std::any_of(hand.apart.begin(), hand.apart.end(), [&](const auto& pair) {
      return pair == std::pair(link, other) || pair == std::pair(other, link);
    });
  };
  std::vector<CapsulePair> pairs;
  for (int a = 0; a < static_cast<int>(capsules.size()); ++a) {
    for (int b = a + 1; b < static_cast<int>(capsules.size()); ++b) {
      const LinkCapsule &ca = capsules[a], &cb = capsules[b];
      if (hand.FindDigitOfLink(ca.link) == hand.FindDigitOfLink(cb.link)) continue;
      if (are_apart(ca.link, cb.link)) continue;
      const ClosestPoints rest =
          FindClosestPoints(X_HL[ca.link] * ca.p_LA, X_HL[ca.link] * ca.p_LB,
                            X_HL[cb.link] * cb.p_LA, X_HL[cb.link] * cb.p_LB);
      if ((rest.on_a - rest.on_b).norm() <= ca.radius + cb.radius) continue;
      pairs.push_back({a, b});
    }
  }
  return pairs;
}

double CalcCapsuleGap(const Hand& hand, const CapsulePair& pair, const std::vector<Pose>& X_HL) {
  const LinkCapsule &a = hand.capsules[pair.a], &b = hand.capsules[pair.b];
  const ClosestPoints nearest = FindClosestPoints(X_HL[a.link] * a.p_LA, X_HL[a.link] * a.p_LB,
                                                  X_HL[b.link] * b.p_LA, X_HL[b.link] * b.p_LB);
  return (nearest.on_a - nearest.on_b).norm() - a.radius - b.radius;
}

namespace {

// Distance of neighbouring balls in radii; the surface dips by r - sqrt(r^2 - (d/2)^2).
constexpr double kSpacing = 1.5;
constexpr double kPadSpacing = 0.8;

/** Positions in [-half, half], symmetric and at most `spacing` apart. */
std::vector<double> Spread(double half, double spacing) {
  const int num_gaps = static_cast<int>(std::ceil(2.0 * half / spacing - 1e-9));
  if (num_gaps <= 0) return {0.0};
  std::vector<double> positions;
  for (int i = 0; i <= num_gaps; ++i) positions.push_back(half * (2.0 * i / num_gaps - 1.0));
  return positions;
}

/** Adds rows of balls along the axis `along`, side by side along the axis `wide`, in the central
plane. */
void AddRows(const CollisionShape& shape, double radius, int along, int wide, bool is_pad,
             Hand& hand) {
  const double spacing = (is_pad ? kPadSpacing : kSpacing) * radius;
  const double half_along = shape.size[along] / 2.0 - radius;
  for (double across : Spread(shape.size[wide] / 2.0 - radius, spacing)) {
    const auto place = [&](double position) -> Eigen::Vector3d {
      Eigen::Vector3d p_SP = Eigen::Vector3d::Zero();
      p_SP[wide] = across;
      p_SP[along] = position;
      return shape.X_LS * p_SP;
    };
    if (!shape.is_self_contact) {
      for (double position : Spread(half_along, spacing)) {
        hand.contact_spheres.push_back({shape.link, place(position), radius});
      }
    }
    if (shape.is_cover) continue;
    hand.capsules.push_back({shape.link, place(-half_along), place(half_along), radius});
  }
}

}  // namespace

void AddContact(const CollisionShape& shape, bool is_pad, Hand& hand) {
  const bool is_disc =
      shape.kind == CollisionShape::Kind::kCylinder && shape.size.z() < shape.size.x();
  if (is_disc || shape.kind == CollisionShape::Kind::kBox) {
    CollisionShape box = shape;
    if (is_disc) box.size.head<2>() *= std::sqrt(kPi) / 2.0;
    int thin, along;
    const double thickness = box.size.minCoeff(&thin);
    box.size.maxCoeff(&along);
    if (along == thin) along = (thin + 1) % 3;  // a cube
    AddRows(box, thickness / 2.0, along, 3 - thin - along, is_pad, hand);
  } else {
    AddRows(shape, shape.size.x() / 2.0, 2, 0, is_pad, hand);
  }
}

}  // namespace graspbench
