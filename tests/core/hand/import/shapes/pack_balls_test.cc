#include "core/hand/import/shapes/pack_balls.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/hand/contact_fit.h"
#include "core/hand/contact_shape.h"
#include "core/shape/primitives.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;

/** A box of `size` with packed balls, measured. */
ContactFit Pack(const Vector3d& size, double smallest = 0.0) {
  const TriMesh box = MakeRoundedBox(size, 0.0);
  Hand hand;
  hand.links.emplace_back().name = "box";
  hand.palm_link = 0;
  for (const Ball& ball : PackBalls(LinkSolid({box}), {}, smallest)) {
    hand.contact_spheres.push_back({0, ball.centre, ball.radius});
    EXPECT_GE(ball.radius, smallest);
    // The exact distance of a box: how far a ball reaches over a face.
    const Vector3d reach = ball.centre.cwiseAbs() + Vector3d::Constant(ball.radius);
    EXPECT_LE((reach - 0.5 * size).maxCoeff(), 0.001);
  }
  return MeasureContact(hand, MakeLinkSolids({{box}})).at(0);
}

TEST(PackBallsTest, CoversBarsPalmsAndPlates) {
  for (const Vector3d& size :
       {Vector3d(0.016, 0.014, 0.042), Vector3d(0.08, 0.03, 0.09), Vector3d(0.06, 0.002, 0.08)}) {
    const ContactFit fit = Pack(size);
    EXPECT_LE(fit.out.most, 0.001) << size.transpose();
    EXPECT_LE(fit.sink.at_95, 0.001) << size.transpose();
    EXPECT_LE(fit.sink.most, 0.005) << size.transpose();
    EXPECT_LE(fit.num_balls, 250) << size.transpose();
  }
}

TEST(PackBallsTest, APadHasNoBallBelow1Mm) {
  EXPECT_LE(Pack({0.016, 0.014, 0.042}, kSmallestPadBall).sink.at_95, 0.0015);
}

// A gripper of 0.3 m has sides of thin sheet: some 600 balls leave holes there.
TEST(PackBallsTest, ALargeSheetGetsAsManyAsItNeeds) {
  const ContactFit fit = Pack({0.2, 0.003, 0.12});
  EXPECT_LE(fit.sink.at_95, 0.001);
  EXPECT_LE(fit.sink.most, 0.005);
  EXPECT_GT(fit.num_balls, 600);
  EXPECT_LT(fit.num_balls, static_cast<int>(kMostBalls));
}

TEST(PackBallsTest, WhatIsCoveredNeedsNone) {
  const LinkSolid solid({MakeSphere(0.01, 48)});
  EXPECT_TRUE(PackBalls(solid, {{0, Vector3d::Zero(), 0.01}}, 0.0).empty());
  EXPECT_LE(PackBalls(solid, {}, 0.0).size(), 3u);
}

/** Normal force of a soft pad's balls on a plane over 4/3 E*, pressed `depth` beyond the first
touch: sum of sqrt(r) d^1.5 (core/physics/contact.h). */
double CalcPadForce(const std::vector<ContactSphere>& balls, const Vector3d& down, double depth) {
  double lowest = -1.0, force = 0.0;
  for (const ContactSphere& ball : balls) {
    lowest = std::max(lowest, ball.p_LS.dot(down) + ball.radius);
  }
  for (const ContactSphere& ball : balls) {
    const double d = ball.p_LS.dot(down) + ball.radius - lowest + depth;
    if (d > 0.0) force += std::sqrt(ball.radius) * std::pow(d, 1.5);
  }
  return force;
}

std::vector<ContactSphere> PackPad(const TriMesh& mesh) {
  std::vector<ContactSphere> balls;
  for (const Ball& ball : PackBalls(LinkSolid({mesh}), {}, kSmallestPadBall)) {
    balls.push_back({0, ball.centre, ball.radius});
  }
  return balls;
}

// A ball of a pad is one contact of its own radius: Hertz's force from every side.
TEST(PackBallsTest, ARoundPadIsAsStiffAsHertzHasIt) {
  for (const double radius : {0.006, 0.01, 0.015}) {
    const std::vector<ContactSphere> balls = PackPad(MakeSphere(radius, 48));
    for (const Vector3d& down : SpreadOnSphere(0.004)) {
      const double hertz = std::sqrt(radius) * std::pow(0.0005, 1.5);
      EXPECT_NEAR(CalcPadForce(balls, down, 0.0005) / hertz, 1.0, 0.05) << radius;
    }
  }
}

// On a flat side no more contacts share the force than in the rows of a pad that is a box.
TEST(PackBallsTest, AFlatPadIsNoStifferThanABox) {
  const Vector3d size(0.016, 0.014, 0.042);
  CollisionShape box;
  box.link = 0;
  box.kind = CollisionShape::Kind::kBox;
  box.size = size;
  Hand of_box;
  AddContact(box, true, of_box);
  for (const double rounding : {0.003, 0.0069}) {
    const std::vector<ContactSphere> balls = PackPad(MakeRoundedBox(size, rounding));
    for (const double depth : {0.0003, 0.001}) {
      EXPECT_LE(CalcPadForce(balls, Vector3d::UnitY(), depth),
                CalcPadForce(of_box.contact_spheres, Vector3d::UnitY(), depth));
    }
  }
}

/** Share of points on the two large sides of a plate in the xy plane within 5 mm of a capsule. */
double CalcNearShare(const Vector3d& size, const std::vector<FittedCapsule>& capsules) {
  int num_near = 0, num_points = 0;
  for (double x = -0.5 * size.x() + 0.001; x < 0.5 * size.x(); x += 0.002) {
    for (double y = -0.5 * size.y() + 0.001; y < 0.5 * size.y(); y += 0.002) {
      const Vector3d p(x, y, 0.5 * size.z());
      ++num_points;
      num_near += std::any_of(capsules.begin(), capsules.end(), [&](const FittedCapsule& capsule) {
        const ClosestPoints nearest = FindClosestPoints(capsule.p_A, capsule.p_B, p, p);
        return (nearest.on_a - p).norm() - capsule.radius < kNearSelfContact;
      });
    }
  }
  return num_near / static_cast<double>(num_points);
}

// Its boundary points lie as far apart as the sheet is thick.
TEST(InscribeCapsulesTest, NoneSticksOutOfASheetOf1Mm) {
  for (const FittedCapsule& capsule :
       InscribeCapsules(LinkSolid({MakeRoundedBox({0.06, 0.09, 0.001}, 0.0)}))) {
    const double reach = std::max(std::abs(capsule.p_A.z()), std::abs(capsule.p_B.z()));
    EXPECT_LE(reach + capsule.radius - 0.0005, 0.0006);
  }
}

// Between two points of half a hollow ball a straight line leaves the wall.
TEST(InscribeCapsulesTest, NoneCrossesTheHollowOfABowl) {
  constexpr double kOuter = 0.011, kInner = 0.0095;
  std::vector<Eigen::Vector2d> profile;
  for (int k = 0; k <= 12; ++k) {
    const double angle = 0.5 * kPi * (k / 12.0 - 1.0);
    profile.emplace_back(kOuter * std::cos(angle), kOuter * std::sin(angle));
  }
  for (int k = 12; k >= 0; --k) {
    const double angle = 0.5 * kPi * (k / 12.0 - 1.0);
    profile.emplace_back(kInner * std::cos(angle), kInner * std::sin(angle));
  }
  const std::vector<FittedCapsule> capsules =
      InscribeCapsules(LinkSolid({MakeRevolution(profile)}));
  ASSERT_FALSE(capsules.empty());
  for (const FittedCapsule& capsule : capsules) {
    for (const double share : {0.0, 0.25, 0.5, 0.75, 1.0}) {
      const double from_middle = (capsule.p_A + share * (capsule.p_B - capsule.p_A)).norm();
      EXPECT_LE(from_middle + capsule.radius - kOuter, kFairContactError);
      EXPECT_LE(kInner - from_middle + capsule.radius, kFairContactError);
    }
  }
}

// Also where trimming leaves one near fewer points than it was taken for: thin plates.
TEST(InscribeCapsulesTest, NoneIsThereTwice) {
  const std::vector<std::vector<TriMesh>> links = {
      {MakeRoundedBox({0.06, 0.09, 0.001}, 0.0)},
      {MakeRoundedBox({0.08, 0.09, 0.0015}, 0.0)},
      {MakeRoundedBox({0.012, 0.012, 0.002}, 0.0), MakeRoundedBox({0.002, 0.012, 0.012}, 0.0)}};
  for (const std::vector<TriMesh>& link : links) {
    const std::vector<FittedCapsule> capsules = InscribeCapsules(LinkSolid(link));
    for (size_t a = 0; a < capsules.size(); ++a) {
      for (size_t b = a + 1; b < capsules.size(); ++b) {
        EXPECT_GT(
            (capsules[a].p_A - capsules[b].p_A).norm() + (capsules[a].p_B - capsules[b].p_B).norm(),
            1e-9)
            << a << " and " << b;
      }
    }
  }
}

// Eight are not enough. None sticks out of a face by more than balls may.
TEST(InscribeCapsulesTest, APlateHasAsManyAsItNeeds) {
  for (const Vector3d& size : {Vector3d(0.08, 0.09, 0.0015), Vector3d(0.12, 0.12, 0.002)}) {
    const std::vector<FittedCapsule> capsules =
        InscribeCapsules(LinkSolid({MakeRoundedBox(size, 0.0)}));
    EXPECT_GT(capsules.size(), 8u);
    EXPECT_LE(capsules.size(), 48u);
    EXPECT_GT(CalcNearShare(size, capsules), 0.5) << size.transpose();
    for (const FittedCapsule& capsule : capsules) {
      const double reach = std::max(std::abs(capsule.p_A.z()), std::abs(capsule.p_B.z()));
      EXPECT_LE(reach + capsule.radius - 0.5 * size.z(), kFairContactError);
    }
  }
  EXPECT_LE(InscribeCapsules(LinkSolid({MakeRoundedBox({0.08, 0.03, 0.09}, 0.0)})).size(), 8u);
}

TEST(InscribeCapsulesTest, LieWithinABarAndReachItsEnds) {
  const Vector3d half(0.008, 0.007, 0.021);
  Eigen::AlignedBox3d bounds;
  for (const FittedCapsule& capsule :
       InscribeCapsules(LinkSolid({MakeRoundedBox(2 * half, 0.0)}))) {
    for (const Vector3d& end : {capsule.p_A, capsule.p_B}) {
      const Vector3d reach = end.cwiseAbs() + Vector3d::Constant(capsule.radius);
      EXPECT_LE((reach - half).maxCoeff(), 0.0003);
      bounds.extend(end + Vector3d::Constant(capsule.radius));
      bounds.extend(end - Vector3d::Constant(capsule.radius));
    }
  }
  EXPECT_GT(bounds.sizes().z(), 0.036);
}

}  // namespace
}  // namespace graspbench
