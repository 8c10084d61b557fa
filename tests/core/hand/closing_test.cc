#include "core/hand/closing.h"

#include <gtest/gtest.h>

#include "core/base/units.h"
#include "core/hand/load_hand.h"

namespace graspbench {
namespace {

TEST(ClosingTest, FingersBendAndDoNotSpread) {
  const Hand hand = LoadHand("tum");
  const std::vector<int> closing = FindClosing(hand);
  for (const char* finger : {"FF", "MF", "TH"}) {
    const std::string name = finger;
    EXPECT_EQ(closing[hand.FindJoint(name + "q1")], 0);
    EXPECT_EQ(closing[hand.FindJoint(name + "q2")], 1);
    EXPECT_EQ(closing[hand.FindJoint(name + "q3")], 1);
    EXPECT_EQ(closing[hand.FindJoint(name + "q4")], 0);  // follows
  }
  // The pads of a hand that closes come nearer to each other.
  const auto calc_width = [&](double share) {
    const Eigen::VectorXd q = CalcClosedPosture(hand, closing, share);
    const Digit &a = hand.digits[0], &b = hand.digits[2];
    return (CalcLinkPose(hand, q, a.distal_link) * a.p_LPad -
            CalcLinkPose(hand, q, b.distal_link) * b.p_LPad)
        .norm();
  };
  EXPECT_LT(calc_width(0.5), calc_width(0.0));
}

/** Two slides along +y and -y that are together at zero, as published grippers have them. */
Hand MakeGripper() {
  Hand hand;
  hand.links.resize(3);
  hand.joints.resize(2);
  hand.digits.resize(2);
  for (int d = 0; d < 2; ++d) {
    HandLink& link = hand.links[d + 1];
    link.parent = 0;
    link.joint = d;
    link.axis = Eigen::Vector3d(0, d == 0 ? 1 : -1, 0);
    hand.joints[d].link = d + 1;
    hand.joints[d].is_prismatic = true;
    hand.joints[d].upper = 0.04;
    hand.digits[d].links = {d + 1};
    hand.digits[d].distal_link = d + 1;
    hand.digits[d].p_LTip = {0, 0, 0.05};
  }
  return hand;
}

TEST(ClosingTest, AGripperThatIsClosedAtZeroClosesDownwards) {
  EXPECT_EQ(FindClosing(MakeGripper()), (std::vector<int>{-1, -1}));
  Hand mirrored = MakeGripper();
  for (HandLink& link : mirrored.links) link.axis = -link.axis;
  for (HandJoint& joint : mirrored.joints) {
    joint.lower = -0.04;
    joint.upper = 0.0;
  }
  EXPECT_EQ(FindClosing(mirrored), (std::vector<int>{1, 1}));
}

// Straight fingers of 100 mm, 60 mm apart, meet after 17 degrees; after 90 they have passed each
// other and are 140 mm apart. Turning the other way they only part.
TEST(ClosingTest, FingersThatPassEachOtherCloseTowardsEachOther) {
  Hand hand = MakeGripper();
  for (int d = 0; d < 2; ++d) {
    const double side = d == 0 ? 1.0 : -1.0;
    HandLink& link = hand.links[d + 1];
    link.X_PJ = MakePose(Eigen::Vector3d(0, 0.03 * side, 0));
    link.axis = Eigen::Vector3d(side, 0, 0);
    hand.joints[d].is_prismatic = false;
    hand.joints[d].upper = 0.5 * kPi;
    hand.digits[d].p_LTip = {0, 0, 0.1};
  }
  EXPECT_EQ(FindClosing(hand), (std::vector<int>{1, 1}));
  for (HandLink& link : hand.links) link.axis = -link.axis;
  EXPECT_EQ(FindClosing(hand), (std::vector<int>{-1, -1}));
}

// Zero in the middle of the stroke: the limits say nothing, the place of the other finger does.
TEST(ClosingTest, SymmetricLimitsCloseTowardsTheOtherDigits) {
  Hand hand = MakeGripper();
  for (int d = 0; d < 2; ++d) {
    const double side = d == 0 ? 1.0 : -1.0;
    HandLink& link = hand.links[d + 1];
    link.X_PJ = MakePose(Eigen::Vector3d(0, 0.06 * side, 0));
    link.axis = Eigen::Vector3d(1, 0, 0);  // of both: one closes by turning up, one down
    hand.joints[d].is_prismatic = false;
    hand.joints[d].lower = -0.5;
    hand.joints[d].upper = 0.5;
    hand.digits[d].p_LTip = {0, 0, 0.1};
  }
  EXPECT_EQ(FindClosing(hand), (std::vector<int>{1, -1}));
}

TEST(ClosingTest, FollowersFollow) {
  Hand hand = MakeGripper();
  hand.joints[1].coupled_to = 0;
  hand.joints[1].is_mimic = true;
  hand.joints[1].mimic_ratio = 0.5;
  const std::vector<int> closing = FindClosing(hand);
  EXPECT_EQ(closing, (std::vector<int>{-1, 0}));
  EXPECT_EQ(CalcClosedPosture(hand, closing, 0.0), Eigen::Vector2d(0.04, 0.02));
}

}  // namespace
}  // namespace graspbench
