#include "core/hand/import/close_loops.h"

#include <gtest/gtest.h>

#include "core/base/units.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;

ForeignJoint MakeHinge(const std::string& name, int parent, int child, const Vector3d& place) {
  ForeignJoint joint;
  joint.name = name;
  joint.kind = ForeignJoint::Kind::kRevolute;
  joint.parent = parent;
  joint.child = child;
  joint.X_PJ = MakePose(place);
  joint.lower = -1.0;
  joint.upper = 1.0;
  return joint;
}

/** A crank (link 1) and a rocker (link 2) at y = 0 and `base`, both upright, and a coupler (link 3)
on the crank, whose far end a point ties to the rocker's. */
ForeignHand MakeFourBar(double crank, double base) {
  ForeignHand hand;
  hand.links.resize(4);
  hand.joints = {MakeHinge("crank", 0, 1, {0.0, 0.0, 0.0}),
                 MakeHinge("rocker", 0, 2, {0.0, base, 0.0}),
                 MakeHinge("coupler", 1, 3, {0.0, 0.0, crank})};
  hand.joints[0].upper = 0.6;
  hand.joints[0].lower = 0.0;
  return hand;
}

std::vector<LoopPoint> MakePoint(double rocker) {
  LoopPoint point;
  point.line = 9;
  point.link_A = 2;
  point.link_B = 3;
  point.p_AP = {0.0, 0.0, rocker};
  return {point};
}

// In a parallelogram the rocker turns as the crank does, and the coupler back by as much.
TEST(CloseLoopsTest, AParallelogramIsALine) {
  ForeignHand hand = MakeFourBar(0.04, 0.03);
  Diagnostics problems;
  CloseLoops(MakePoint(0.04), {0}, "h", problems, hand);
  ASSERT_TRUE(hand.joints[1].mimic && hand.joints[2].mimic);
  EXPECT_NEAR(hand.joints[1].mimic->ratio, 1.0, 1e-4);
  EXPECT_NEAR(hand.joints[2].mimic->ratio, -1.0, 1e-4);
  EXPECT_NEAR(hand.joints[1].mimic->offset, 0.0, 1e-4);
  EXPECT_EQ(problems.Format(),
            "h:9: warning: a loop of links is cut; its joint \"rocker\" follows \"crank\" 1 times, "
            "as the loop has it with nothing touching, off by 0.0 deg at most\n"
            "h:9: warning: a loop of links is cut; its joint \"coupler\" follows \"crank\" -1 "
            "times, as the loop has it with nothing touching, off by 0.0 deg at most");
}

// Freudenstein's equation, both ends of the range: with a crank of 30, a rocker of 40 and a base of
// 50 mm the coupler's length stays.
TEST(CloseLoopsTest, AnUnequalFourBarKeepsItsCoupler) {
  const double crank = 0.03, rocker = 0.04, base = 0.05;
  ForeignHand hand = MakeFourBar(crank, base);
  Diagnostics problems;
  CloseLoops(MakePoint(rocker), {0}, "h", problems, hand);
  ASSERT_TRUE(hand.joints[1].mimic);
  const double length = Vector3d(0.0, base, rocker - crank).norm();
  for (const double q : {0.0, 0.3, 0.6}) {
    const double follower = hand.joints[1].mimic->offset + hand.joints[1].mimic->ratio * q;
    // A turn about x takes z to -y.
    const Vector3d end(0.0, -crank * std::sin(q), crank * std::cos(q));
    const Vector3d other(0.0, base - rocker * std::sin(follower), rocker * std::cos(follower));
    EXPECT_NEAR((end - other).norm(), length, 0.001) << q;
  }
  EXPECT_NE(problems.Format().find("off by "), std::string::npos);
}

// One joint more than the loop needs: the spring holds the coupler, at its rest.
TEST(CloseLoopsTest, ASpringDecidesWhatTheLoopLeavesOpen) {
  ForeignHand hand = MakeFourBar(0.04, 0.03);
  hand.links.resize(5);
  hand.joints.push_back(MakeHinge("finger", 2, 4, {0.0, 0.015, 0.02}));
  hand.joints[0].upper = 0.2;
  hand.joints[2].spring_stiffness = 0.05;
  hand.joints[2].spring_rest = 0.05;
  std::vector<LoopPoint> points = MakePoint(0.0);
  points[0].link_A = 4;
  points[0].p_AP = {0.0, -0.015, 0.02};
  Diagnostics problems;
  CloseLoops(points, {0}, "h", problems, hand);
  EXPECT_EQ(hand.joints[2].kind, ForeignJoint::Kind::kFixed) << problems.Format();
  EXPECT_NEAR(Eigen::AngleAxisd(hand.joints[2].X_PJ.linear()).angle(), 0.05, 1e-4);
  EXPECT_TRUE(hand.joints[1].mimic && hand.joints[3].mimic) << problems.Format();
}

TEST(CloseLoopsTest, WhatNoDriveMovesOrCannotCloseIsTold) {
  ForeignHand hand = MakeFourBar(0.04, 0.03);
  Diagnostics problems;
  CloseLoops(MakePoint(0.04), {}, "h", problems, hand);
  hand.joints[1].upper = 0.2;  // of a crank that goes to 0.6
  CloseLoops(MakePoint(0.04), {0}, "h", problems, hand);
  EXPECT_FALSE(hand.joints[1].mimic);
  EXPECT_NE(
      problems.Format().find(
          "h:9: warning: a loop of links is cut: not one drive moves it; joints that nothing "
          "else ties get drives of their own\nh:9: warning: a loop of links is cut: within its "
          "limits it stays open by up to "),
      std::string::npos)
      << problems.Format();
}

// q2 = 1 + 2 q1 and q1 = 0.5 - q0: q2 = 2 - 2 q0.
TEST(FollowJointTest, FollowersFollowOn) {
  ForeignHand hand;
  hand.joints.resize(3);
  FollowJoint(hand, 2, 1, 2.0, 1.0);
  FollowJoint(hand, 1, 0, -1.0, 0.5);
  EXPECT_EQ(hand.joints[2].mimic->joint, 0);
  EXPECT_EQ(hand.joints[2].mimic->ratio, -2.0);
  EXPECT_EQ(hand.joints[2].mimic->offset, 2.0);
}

}  // namespace
}  // namespace graspbench
