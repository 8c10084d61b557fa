#include "core/develop/development_warnings.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "core/base/units.h"
#include "core/hand/load_hand.h"

namespace graspbench {
namespace {

DevelopedGrasp MakeDeveloped(int num_held, int num_shapes, int num_failed, int num_trials) {
  DevelopedGrasp developed;
  for (int k = 0; k < num_shapes; ++k) {
    developed.check.push_back({k < num_held ? Outcome::kSuccess : Outcome::kNoContact, 0.0});
  }
  developed.num_trials = num_trials;
  developed.num_numerical_failures = num_failed;
  return developed;
}

size_t CountWarnings(int num_held, int num_shapes, int num_failed, int num_trials) {
  return ListDevelopmentWarnings(Hand(),
                                 MakeDeveloped(num_held, num_shapes, num_failed, num_trials))
      .size();
}

// tum's thumb and index oppose; two fingers side by side on a palm do not.
TEST(DevelopmentWarnings, TwoDigitsThatFailAreAskedWhetherTheyCanOppose) {
  const Hand hand = LoadHand("tum");
  DevelopedGrasp developed = MakeDeveloped(5, 24, 0, 500);
  developed.grasp.digits = {"TH", hand.digits.front().id};
  EXPECT_TRUE(ListDevelopmentWarnings(hand, developed).empty());
  developed.grasp.digits = {hand.digits[0].id, hand.digits[1].id};
  const auto warnings = ListDevelopmentWarnings(hand, developed);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].find(" cannot oppose: "), std::string::npos);
  developed.check = MakeDeveloped(12, 24, 0, 500).check;
  EXPECT_TRUE(ListDevelopmentWarnings(hand, developed).empty());
}

TEST(DevelopmentWarnings, NamesNumericalFailuresAboveOnePercent) {
  EXPECT_EQ(CountWarnings(24, 24, 5, 500), 0u);  // 1 %
  EXPECT_EQ(CountWarnings(24, 24, 6, 500), 1u);
  EXPECT_EQ(CountWarnings(0, 24, 6, 500), 2u);
  EXPECT_NE(ListDevelopmentWarnings(Hand(), MakeDeveloped(24, 24, 8, 500))
                .front()
                .find("8 of 500 trials (1.6 %) failed numerically"),
            std::string::npos);
}

using Eigen::Vector3d;

/** Two fingers 60 mm apart along y on the palm, each one link of 50 mm along z that turns about an
axis. The pad of the first faces +y; that of the second is turned about z by `turn` from facing -y.
*/
Hand MakePair(const Vector3d& axis, double turn, double range) {
  Hand hand;
  hand.links.resize(3);
  for (int k : {0, 1}) {
    HandLink& link = hand.links[k + 1];
    link.parent = 0;
    link.joint = k;
    link.X_PJ = MakePose(Vector3d(0.0, k == 0 ? -0.03 : 0.03, 0.0));
    link.axis = axis;
    HandJoint joint;
    joint.name = k == 0 ? "a" : "b";
    joint.link = k + 1;
    joint.lower = -range;
    joint.upper = range;
    hand.joints.push_back(joint);
    Digit digit;
    digit.id = k == 0 ? "A" : "B";
    digit.is_thumb = k == 0;
    digit.links = {k + 1};
    digit.distal_link = k + 1;
    digit.p_LTip = Vector3d(0.0, 0.0, 0.05);
    const double facing = (k == 0 ? 0.5 : -0.5) * kPi + (k == 0 ? 0.0 : turn);
    digit.p_LPad = Vector3d(0.005 * std::cos(facing), 0.005 * std::sin(facing), 0.04);
    hand.digits.push_back(digit);
  }
  return hand;
}

// A pad turned by phi about the finger cannot turn back when the finger bends about x: its normal
// keeps the part sin(phi) along x, the line between the pads has next to none.
TEST(DigitOpposition, IsWhatJointsAndPadsAllow) {
  const Hand facing = MakePair(Vector3d::UnitX(), 0.0, 0.8);
  EXPECT_LT(FindOpposition(facing, 0, 1).angle, RadFromDeg(2.0));
  EXPECT_TRUE(ListPairsApart(facing, {"A", "B"}).empty());

  const Hand aside = MakePair(Vector3d::UnitX(), RadFromDeg(70.0), 0.8);
  const double angle = FindOpposition(aside, 0, 1).angle;
  EXPECT_GT(angle, RadFromDeg(68.0));
  EXPECT_LT(angle, RadFromDeg(78.0));
  const auto told = ListPairsApart(aside, {"A", "B"});
  ASSERT_EQ(told.size(), 1u);
  EXPECT_EQ(told[0].find("A and B cannot oppose: their pads face each other within "), 0u);
}

// About its own length a finger turns its pad wherever it is wanted.
TEST(DigitOpposition, AJointThatTurnsThePadMakesUpForIt) {
  const Hand turning = MakePair(Vector3d::UnitZ(), RadFromDeg(70.0), RadFromDeg(80.0));
  EXPECT_LT(FindOpposition(turning, 0, 1).angle, RadFromDeg(5.0));
}

TEST(DigitOpposition, PadsThatNeverComeNearAreNamed) {
  Hand hand = MakePair(Vector3d::UnitX(), 0.0, 0.1);
  hand.links[2].X_PJ = MakePose(Vector3d(0.0, 0.3, 0.0));
  const auto told = ListPairsApart(hand, {"A", "B"});
  ASSERT_EQ(told.size(), 1u);
  EXPECT_EQ(told[0], "A and B cannot oppose: their pads come no nearer than 90 mm");
}

}  // namespace
}  // namespace graspbench
