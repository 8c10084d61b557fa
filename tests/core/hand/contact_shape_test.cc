#include "core/hand/contact_shape.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/base/random.h"
#include "core/base/units.h"
#include "core/shape/primitives.h"

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

TEST(AddContactTest, ACoverIsForObjectsAndASelfContactForTheHand) {
  CollisionShape shape;
  shape.size.setConstant(0.02);
  Hand cover, self;
  shape.is_cover = true;
  AddContact(shape, false, cover);
  shape.is_cover = false;
  shape.is_self_contact = true;
  AddContact(shape, false, self);
  EXPECT_EQ(cover.contact_spheres.size(), 1u);
  EXPECT_TRUE(cover.capsules.empty());
  EXPECT_TRUE(self.contact_spheres.empty());
  EXPECT_EQ(self.capsules.size(), 1u);
}

Vector3d DrawPoint(RandomStream& stream) {
  return {stream.NextUniform(-1, 1), stream.NextUniform(-1, 1), stream.NextUniform(-1, 1)};
}

TEST(ClosestPointsTest, NoOtherPairIsCloser) {
  RandomStream stream("1", "segments");
  for (int trial = 0; trial < 50; ++trial) {
    const Vector3d a0 = DrawPoint(stream), a1 = trial % 7 ? DrawPoint(stream) : a0;
    const Vector3d b0 = DrawPoint(stream), b1 = trial % 5 ? DrawPoint(stream) : b0;
    const ClosestPoints found = FindClosestPoints(a0, a1, b0, b1);
    const double distance = (found.on_a - found.on_b).norm();
    double nearest = 1e9;
    constexpr int kSteps = 100;
    for (int i = 0; i <= kSteps; ++i) {
      for (int k = 0; k <= kSteps; ++k) {
        const Vector3d a = a0 + (a1 - a0) * i / kSteps, b = b0 + (b1 - b0) * k / kSteps;
        nearest = std::min(nearest, (a - b).norm());
      }
    }
    EXPECT_LE(distance, nearest + 1e-12) << trial;
    EXPECT_GE(distance, nearest - 0.04) << trial;
  }
}

/** A palm and two fingers of one link each, which stand along z. */
Hand MakeHand() {
  Hand hand;
  hand.links.resize(3);
  for (const int finger : {1, 2}) {
    hand.links[static_cast<size_t>(finger)].parent = 0;
    hand.links[static_cast<size_t>(finger)].X_PJ =
        MakePose(Vector3d(finger == 1 ? 0.03 : -0.03, 0, 0.02));
    Digit digit;
    digit.links = {finger};
    hand.digits.push_back(digit);
    hand.capsules.push_back({finger, Vector3d::Zero(), Vector3d(0, 0, 0.05), 0.008});
  }
  return hand;
}

TEST(CapsulePairsTest, FingersMeetButNotThemselvesNorWhatTheyAreBuiltOn) {
  Hand hand = MakeHand();
  ASSERT_EQ(FindCapsulePairs(hand).size(), 1u);
  const std::vector<Pose> X_HL = CalcLinkPoses(hand, Eigen::VectorXd());
  EXPECT_NEAR(CalcCapsuleGap(hand, FindCapsulePairs(hand).front(), X_HL), 0.06 - 0.016, 1e-12);
  hand.capsules.push_back({1, Vector3d(0, 0.05, 0), Vector3d(0, 0.05, 0.05), 0.008});
  EXPECT_EQ(FindCapsulePairs(hand).size(), 2u);  // each of the first finger with the second
  // A palm that the fingers stand in.
  hand.capsules.push_back({0, Vector3d(-0.05, 0, 0.02), Vector3d(0.05, 0, 0.02), 0.01});
  EXPECT_EQ(FindCapsulePairs(hand).size(), 3u);  // and with what stands free of it
}

}  // namespace
}  // namespace graspbench
