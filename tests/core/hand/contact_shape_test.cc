#include "core/hand/contact_shape.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace graspbench {
namespace {

using Eigen::Vector3d;

Hand Make(CollisionShape::Kind kind, const Vector3d& size, bool is_pad = false) {
  Hand hand;
  AddContact({3, Pose::Identity(), kind, size}, is_pad, hand);
  return hand;
}

/** Extent of the union of balls along each axis. */
std::pair<Vector3d, Vector3d> CalcExtent(const Hand& hand) {
  Vector3d low = Vector3d::Constant(1e9), high = -low;
  for (const ContactSphere& s : hand.contact_spheres) {
    low = low.cwiseMin((s.p_LS.array() - s.radius).matrix());
    high = high.cwiseMax((s.p_LS.array() + s.radius).matrix());
  }
  return {low, high};
}

TEST(ContactShapeTest, ASphereStaysOne) {
  const Hand hand = Make(CollisionShape::Kind::kSphere, Vector3d::Constant(0.02));
  ASSERT_EQ(hand.contact_spheres.size(), 1u);
  EXPECT_EQ(hand.contact_spheres[0].link, 3);
  EXPECT_EQ(hand.contact_spheres[0].radius, 0.01);
  ASSERT_EQ(hand.capsules.size(), 1u);
  EXPECT_EQ(hand.capsules[0].p_LA, hand.capsules[0].p_LB);
}

TEST(ContactShapeTest, ACylinderEndsWhereItsBallsEnd) {
  const Hand hand = Make(CollisionShape::Kind::kCylinder, {0.014, 0.014, 0.05});
  const auto [low, high] = CalcExtent(hand);
  EXPECT_LT((high - Vector3d(0.007, 0.007, 0.025)).norm(), 1e-15);
  EXPECT_LT((low + Vector3d(0.007, 0.007, 0.025)).norm(), 1e-15);
  ASSERT_EQ(hand.capsules.size(), 1u);
  EXPECT_NEAR((hand.capsules[0].p_LB - hand.capsules[0].p_LA).norm(), 0.036, 1e-15);
}

TEST(ContactShapeTest, TheSurfaceBetweenBallsDipsLittle) {
  for (bool is_pad : {false, true}) {
    const Hand hand = Make(CollisionShape::Kind::kCylinder, {0.014, 0.014, 0.06}, is_pad);
    for (size_t i = 1; i < hand.contact_spheres.size(); ++i) {
      const double half =
          0.5 * (hand.contact_spheres[i].p_LS - hand.contact_spheres[i - 1].p_LS).norm();
      const double dip = 0.007 - std::sqrt(0.007 * 0.007 - half * half);
      EXPECT_LT(dip, 0.007 * (is_pad ? 1.0 / 11.9 : 0.34));
    }
  }
}

TEST(ContactShapeTest, ABoxIsALayerWithinItsFaces) {
  // Whatever axis is the thin one.
  for (int turn = 0; turn < 3; ++turn) {
    Vector3d size;
    for (int axis = 0; axis < 3; ++axis) {
      size[(axis + turn) % 3] = Vector3d(0.022, 0.064, 0.086)[axis];
    }
    const Hand hand = Make(CollisionShape::Kind::kBox, size);
    const auto [low, high] = CalcExtent(hand);
    EXPECT_LT((high - size / 2.0).norm(), 1e-15);
    EXPECT_LT((low + size / 2.0).norm(), 1e-15);
    EXPECT_EQ(hand.contact_spheres.size(), 20u);
    EXPECT_EQ(hand.capsules.size(), 4u);
  }
}

TEST(ContactShapeTest, ACubeIsOneBallAndADiscALayer) {
  EXPECT_EQ(Make(CollisionShape::Kind::kBox, Vector3d::Constant(0.02)).contact_spheres.size(), 1u);
  const Hand disc = Make(CollisionShape::Kind::kCylinder, {0.1, 0.1, 0.02});
  const auto [low, high] = CalcExtent(disc);
  EXPECT_NEAR(high.z(), 0.01, 1e-15);
  const Vector3d size = high - low;
  EXPECT_NEAR(size.prod(), EIGEN_PI * 0.05 * 0.05 * 0.02, 1e-12);
}

}  // namespace
}  // namespace graspbench
