#include "core/hand/import/free_joints.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "core/base/units.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;

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
TEST(FreeJointsTest, AShapeThatBlocksItsJointIsLeftOut) {
  ImportedHand imported = MakeImported(kPi);
  Diagnostics problems;
  FreeJoints("hand.urdf", imported, problems);
  ASSERT_EQ(imported.shapes.size(), 2u);
  EXPECT_EQ(imported.shapes[0].link, 0);
  EXPECT_NEAR(imported.shapes[1].size.x(), 0.01, 1e-12);  // that about the axis stays
  EXPECT_EQ(problems.Format(),
            "hand.urdf: warning: link \"finger\": 1 of its balls and capsules would meet the palm "
            "within the limits of joint \"turn\", by up to 3.0 mm; left out of contact");
}

// A finger of one capsule, 6 mm from its axis to 34 mm: what lies farther than 17 mm from the axis
// meets the palm when it is turned by half a circle.
TEST(FreeJointsTest, AWholeFingerIsCutAndKeepsWhatDoesNotMeetThePalm) {
  ImportedHand imported = MakeImported(kPi);
  imported.notes.resize(3);
  CollisionShape capsule = MakeBall(1, Vector3d(0.02, 0, 0), 0.006);
  capsule.kind = CollisionShape::Kind::kCylinder;
  capsule.size.z() = 0.028 + 0.012;
  capsule.X_LS.linear() =
      Eigen::Quaterniond::FromTwoVectors(Vector3d::UnitZ(), Vector3d::UnitX()).toRotationMatrix();
  imported.shapes = {imported.shapes[0], capsule};
  Diagnostics problems;
  FreeJoints("hand.urdf", imported, problems);
  // Axes of the pieces end at 6 + 3.5 k mm, a ball of 6 mm beyond; the palm begins at 25 mm.
  ASSERT_EQ(imported.shapes.size(), 1u + 3u);
  for (size_t k = 1; k < imported.shapes.size(); ++k) {
    EXPECT_EQ(imported.shapes[k].link, 1);
    EXPECT_NEAR(imported.shapes[k].X_LS.translation().x(),
                0.006 + 0.0035 * (static_cast<double>(k) - 0.5), 1e-12);
    EXPECT_NEAR(imported.shapes[k].size.z(), 0.012 + 0.0035, 1e-12);
  }
  EXPECT_NE(problems.Format().find("1 of its balls and capsules would meet the palm"),
            std::string::npos);
  EXPECT_NE(problems.Format().find("cut along their length, 3 pieces stay"), std::string::npos);
  EXPECT_NE(imported.notes[1].find("guess"), std::string::npos);
}

TEST(FreeJointsTest, ALinkThatKeepsNoContactIsNamed) {
  ImportedHand imported = MakeImported(kPi);
  imported.notes.resize(3);
  imported.shapes.pop_back();  // the ball about the axis
  Diagnostics problems;
  FreeJoints("hand.urdf", imported, problems);
  EXPECT_EQ(imported.shapes.size(), 1u);
  EXPECT_NE(problems.Format().find("nothing of the link will touch"), std::string::npos);
}

// The jaw of a gripper slides on the palm itself: without its shapes nothing would grasp.
TEST(FreeJointsTest, WhatCarriesThePadKeepsItsShapes) {
  ImportedHand imported = MakeImported(kPi);
  imported.hand.digits[0].links = {1};
  imported.hand.digits[0].distal_link = 1;
  Diagnostics problems;
  FreeJoints("hand.urdf", imported, problems);
  EXPECT_EQ(imported.shapes.size(), 3u);
  EXPECT_EQ(problems.Format(), "");
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
