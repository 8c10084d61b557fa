#include "core/hand/import/link_contact.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "core/base/units.h"
#include "core/hand/import/shapes/pack_balls.h"
#include "core/shape/primitives.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;

/** A box for a palm and one, 20 x 27 x 54 mm, for the link of a digit. */
ImportedHand MakeImported() {
  ImportedHand imported;
  const Vector3d size(0.02, 0.027, 0.054);
  for (const int link : {0, 1}) {
    imported.hand.links.emplace_back().name = link == 0 ? "palm" : "finger";
    CollisionShape& box = imported.shapes.emplace_back();
    box.link = link;
    box.kind = CollisionShape::Kind::kBox;
    box.size = size;
    imported.solids.push_back({MakeRoundedBox(size, 0.0)});
    imported.notes.emplace_back();
  }
  Digit digit;
  digit.links = {1};
  digit.distal_link = 1;
  imported.hand.digits = {digit};
  return imported;
}

TEST(CoverLinksTest, EveryLinkGetsBallsThatOtherLinksDoNotMeet) {
  ImportedHand imported = MakeImported();
  CoverLinks(MakeLinkSolids(imported.solids), kNumCoverPoints, imported);
  int num_of_palm = 0;
  for (size_t k = 2; k < imported.shapes.size(); ++k) {
    EXPECT_TRUE(imported.shapes[k].is_cover);
    num_of_palm += imported.shapes[k].link == 0;
    EXPECT_GE(imported.shapes[k].size.x(), imported.shapes[k].link == 1 ? 0.002 : 0.0);  // a pad's
  }
  EXPECT_GT(num_of_palm, 10);
  EXPECT_TRUE(imported.visuals.empty()) << "its boxes are drawn";
}

TEST(CoverLinksTest, WhatStoodForAMeshIsReplacedByCapsulesForTheHandItself) {
  ImportedHand imported = MakeImported();
  imported.shapes[0].is_fitted = true;
  CoverLinks(MakeLinkSolids(imported.solids), kNumCoverPoints, imported);
  int num_capsules = 0;
  for (const CollisionShape& shape : imported.shapes) {
    EXPECT_FALSE(shape.is_fitted);
    num_capsules += shape.is_self_contact;
  }
  EXPECT_GE(num_capsules, 1);
  EXPECT_LE(num_capsules, 8);
  ASSERT_EQ(imported.visuals.size(), 2u) << "else there is nothing to see";
  EXPECT_EQ(imported.visuals[1].link, 1);
  EXPECT_EQ(imported.visuals[1].visual.mesh.num_vertices(), imported.solids[1][0].num_vertices());
}

// A ball of 40 mm for a link of 20 x 27 x 54 mm sticks out of it by 10 mm.
TEST(MeasureLinksTest, MoreThan5MmOnATipIsRefusedUnlessAccepted) {
  for (const bool accepts : {false, true}) {
    ImportedHand imported = MakeImported();
    const LinkSolids solids = MakeLinkSolids(imported.solids);
    CoverLinks(solids, kNumCoverPoints, imported);
    CollisionShape& ball = imported.shapes[1];
    ball.kind = CollisionShape::Kind::kSphere;
    ball.size.setConstant(0.04);
    Diagnostics problems;
    MeasureLinks("hand.urdf", accepts, solids, imported, problems);
    EXPECT_EQ(problems.num_errors(), accepts ? 0 : 1) << problems.Format();
    ASSERT_EQ(imported.fits.size(), 2u);
    EXPECT_LE(imported.fits[0].out.most, 0.001);
    EXPECT_NEAR(imported.fits[1].out.most, 0.010, 0.0001);
    EXPECT_NE(problems.Format().find("link \"finger\": its "), std::string::npos);
  }
}

// A sheet of 0.4 m has more surface than 2400 balls cover; a palm's holes count as a tip's do.
TEST(MeasureLinksTest, ASheetTooLargeForTheMostBallsIsRefusedUnlessAccepted) {
  ImportedHand imported = MakeImported();
  const Vector3d size(0.4, 0.002, 0.4);
  imported.hand.palm_normal = Vector3d::UnitY();
  imported.solids[0] = {MakeRoundedBox(size, 0.0)};
  imported.shapes[0].size.setConstant(0.001);
  const LinkSolids solids = MakeLinkSolids(imported.solids);
  CoverLinks(solids, kNumCoverPoints, imported);
  for (const bool accepts : {false, true}) {
    Diagnostics problems;
    MeasureLinks("hand.urdf", accepts, solids, imported, problems);
    EXPECT_EQ(problems.num_errors(), accepts ? 0 : 1) << problems.Format();
    ASSERT_EQ(imported.fits.size(), 2u);
    EXPECT_EQ(imported.fits[0].num_balls, static_cast<int>(kMostBalls) + 1) << "and its own box";
    const bool is_told = problems.Format().find(
                             "5 mm at most on the palmar side and on tips. A link may have 2400 "
                             "balls, too few for this surface. --coarse-contact takes it as it "
                             "is") != std::string::npos;
    EXPECT_EQ(is_told, !accepts) << problems.Format();
  }
}

CollisionShape MakeBall(int link, const Vector3d& centre, double radius) {
  CollisionShape shape;
  shape.link = link;
  shape.X_LS = MakePose(centre);
  shape.size = Vector3d::Constant(2.0 * radius);
  return shape;
}

/** A ball for a palm; 40 mm beside it a finger that turns about z, with a ball 20 mm from its axis,
and at its end a tip without shapes. */
ImportedHand MakeImported(double upper) {
  ImportedHand imported;
  Hand& hand = imported.hand;
  hand.links.resize(3);
  hand.links[0].name = "palm";
  hand.links[1].name = "finger";
  hand.links[1].parent = 0;
  hand.links[1].joint = 0;
  hand.links[1].X_PJ = MakePose(Vector3d(0.04, 0, 0));
  hand.links[1].axis = Vector3d::UnitZ();
  HandJoint joint;
  joint.name = "turn";
  joint.link = 1;
  joint.upper = upper;
  hand.links[2].name = "tip";
  hand.links[2].parent = 1;
  hand.links[2].joint = 1;
  hand.links[2].X_PJ = MakePose(Vector3d(0.05, 0, 0));
  hand.links[2].axis = Vector3d::UnitZ();
  HandJoint bend;
  bend.name = "bend";
  bend.link = 2;
  hand.joints = {joint, bend};
  Digit digit;
  digit.links = {1, 2};
  digit.distal_link = 2;
  hand.digits = {digit};
  imported.shapes = {MakeBall(0, Vector3d::Zero(), 0.015), MakeBall(1, Vector3d(0.02, 0, 0), 0.008),
                     MakeBall(1, Vector3d::Zero(), 0.005)};
  return imported;
}

// Turned by half a circle the ball is 20 mm from the palm's middle, 3 mm too near.
TEST(FreeJointsTest, ALinkThatEntersThePalmNeverTouchesItButKeepsItsShapes) {
  ImportedHand imported = MakeImported(kPi);
  Diagnostics problems;
  FreeJoints("hand.urdf", imported, problems);
  EXPECT_EQ(imported.shapes.size(), 3u);
  ASSERT_EQ(imported.hand.apart.size(), 1u);
  EXPECT_EQ(imported.hand.apart[0], std::pair(0, 1));
  EXPECT_EQ(problems.Format(),
            "hand.urdf: warning: link \"finger\" would enter the palm by up to 3.0 mm within the "
            "limits of joint \"turn\"; the two never touch each other");
}

// A second axis 15 mm from the first is still the digit's root, one at 50 mm is not.
TEST(FreeJointsTest, OnlyJointsAtTheRootOfADigitAreFreed) {
  for (const double distance : {0.015, 0.05}) {
    ImportedHand imported = MakeImported(kPi);
    imported.hand.links[2].X_PJ = MakePose(Vector3d(distance, 0, 0));
    imported.hand.joints[1].lower = -kPi;
    imported.hand.joints[1].upper = kPi;
    imported.shapes = {imported.shapes[0], MakeBall(2, Vector3d(0.03, 0, 0), 0.008)};
    Diagnostics problems;
    FreeJoints("hand.urdf", imported, problems);
    EXPECT_EQ(imported.hand.apart.size(), distance < 0.025 ? 1u : 0u) << distance;
  }
}

TEST(FreeJointsTest, WithinItsLimitsNothingChanges) {
  ImportedHand imported = MakeImported(0.5 * kPi);
  Diagnostics problems;
  FreeJoints("hand.urdf", imported, problems);
  EXPECT_EQ(imported.shapes.size(), 3u);
  EXPECT_EQ(problems.Format(), "");
}

}  // namespace
}  // namespace graspbench
