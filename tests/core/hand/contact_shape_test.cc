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

// A cylinder is contact as the capsule within it, so it sticks out of a shorter box at both ends.
TEST(ContactProtrusionTest, OfACapsuleBeyondABox) {
  CollisionShape cylinder;
  cylinder.kind = CollisionShape::Kind::kCylinder;
  cylinder.size = {0.02, 0.02, 0.1};
  const TriMesh box = MakeRoundedBox({0.02, 0.02, 0.09}, 0.0);
  EXPECT_NEAR(CalcContactProtrusion({cylinder}, {box}), 0.005, 1e-7);
  // Two meshes have one hull.
  TriMesh higher = box;
  for (Eigen::Vector3d& p : higher.vertices) p.z() += 0.003;
  EXPECT_NEAR(CalcContactProtrusion({cylinder}, {higher, box}), 0.005, 1e-7);
  EXPECT_NEAR(CalcContactProtrusion({cylinder}, {higher}), 0.008, 1e-7);
}

TEST(ContactProtrusionTest, OfAHandIsOfLinksWithContactAndPicture) {
  Hand hand;
  for (const char* name : {"palm", "unseen", "untouched"}) hand.links.emplace_back().name = name;
  hand.contact_spheres = {{0, {0.0, 0.0, 0.02}, 0.01}, {1, {0.0, 0.0, 0.0}, 0.01}};
  const TriMesh cube = MakeRoundedBox({0.05, 0.05, 0.05}, 0.0);
  hand.visuals.resize(2);
  hand.visuals[0].link = 0;
  hand.visuals[1].link = 2;
  hand.visuals[0].mesh = hand.visuals[1].mesh = cube;
  const std::vector<LinkProtrusion> protrusions = CalcContactProtrusions(hand);
  ASSERT_EQ(protrusions.size(), 1u);
  EXPECT_EQ(protrusions[0].link, "palm");
  EXPECT_NEAR(protrusions[0].protrusion, 0.005, 1e-7);
}

constexpr double kExact = 1e-7;  // [m]

/** Corners of a cube of 40 mm about the origin, twice, and points within. */
std::vector<Vector3d> MakeCube() {
  std::vector<Vector3d> points;
  for (int k = 0; k < 24; ++k) {
    const double half = k < 16 ? 0.02 : 0.01;
    points.emplace_back(k & 1 ? half : -half, k & 2 ? half : -half, k & 4 ? half : -half);
  }
  return points;
}

TEST(ProtrusionTest, OutOfACubeOverAFaceAnEdgeAndACorner) {
  const std::vector<Vector3d> cube = MakeCube();
  EXPECT_EQ(CalcProtrusion(cube, {}), 0.0);
  EXPECT_NEAR(CalcProtrusion(cube, {{{0.004, 0.0, 0.003}, 0.012}}), 0.0, kExact);
  // The centre within: r less the depth of the nearest face.
  EXPECT_NEAR(CalcProtrusion(cube, {{{0.004, 0.0, 0.015}, 0.012}}), 0.007, kExact);
  EXPECT_NEAR(CalcProtrusion(cube, {{{-0.019, 0.003, -0.002}, 0.012}}), 0.011, kExact);
  // Outside: r and the distance of the centre.
  EXPECT_NEAR(CalcProtrusion(cube, {{{0.023, 0.024, 0.001}, 0.002}}), 0.007, kExact);
  EXPECT_NEAR(CalcProtrusion(cube, {{{0.022, 0.023, -0.026}, 0.002}}), 0.009, kExact);
  // The largest of all balls, in any order.
  const Ball within{{0.0, 0.0, 0.0}, 0.01}, beyond{{0.0, 0.0, 0.02}, 0.01};
  EXPECT_NEAR(CalcProtrusion(cube, {within, beyond}), 0.01, kExact);
  EXPECT_NEAR(CalcProtrusion(cube, {beyond, within}), 0.01, kExact);
}

// Of a ball of radius R about the origin: |c| + r - R.
TEST(ProtrusionTest, OutOfASphere) {
  const std::vector<Vector3d> sphere = MakeSphere(0.03, 128).vertices;
  const double facets = 0.03 * (1.0 - std::cos(kPi / 128.0));
  for (const Vector3d& c : {Vector3d(0.01, 0.005, 0.003), Vector3d(0.002, -0.03, 0.02)}) {
    const double expected = c.norm() + 0.03 - 0.03;
    EXPECT_GT(CalcProtrusion(sphere, {{c, 0.03}}), expected - 0.01 * 0.03);
    EXPECT_LT(CalcProtrusion(sphere, {{c, 0.03}}), expected + 2.0 * facets + 5e-5);
  }
}

// Half a tube and the whole ball of its radius: out of the open side by the radius.
TEST(ProtrusionTest, OutOfTheOpenSideOfHalfATube) {
  std::vector<Vector3d> tube;
  for (int k = 0; k <= 90; ++k) {
    const double angle = kPi * k / 90.0;
    for (const double r : {0.04, 0.042}) {
      for (const double z : {-0.045, 0.045}) {
        tube.emplace_back(r * std::cos(angle), r * std::sin(angle), z);
      }
    }
  }
  EXPECT_NEAR(CalcProtrusion(tube, {{{0.0, 0.0, 0.001}, 0.042}}), 0.042, kExact);
  EXPECT_NEAR(CalcProtrusion(tube, {{{0.0, 0.0, 0.033}, 0.042}}), 0.042, kExact);
  // A ball in the hollow, 2 mm below the open side.
  EXPECT_NEAR(CalcProtrusion(tube, {{{0.0, 0.012, 0.0}, 0.01}}), 0.0, kExact);
}

// A plate of no thickness, one point, all points on a line: a ball sticks out by its own radius or
// more.
TEST(ProtrusionTest, OutOfWhatHasNoVolume) {
  const Ball ball{{0.0, 0.0, 0.004}, 0.002};
  EXPECT_NEAR(CalcProtrusion({Vector3d::Zero()}, {ball}), 0.006, kExact);
  EXPECT_NEAR(CalcProtrusion({{-1.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {0.5, 0.0, 0.0}}, {ball}), 0.006,
              kExact);
  EXPECT_NEAR(CalcProtrusion({{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}, {ball}), 0.006,
              kExact);
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
