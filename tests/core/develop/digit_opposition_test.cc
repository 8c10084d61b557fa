#include "core/develop/digit_opposition.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "core/base/units.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;

/** Two fingers 60 mm apart along y on the palm, each one link of 50 mm along z that turns about an
axis. The pad of the first faces +y; that of the second is turned about z by `turn` from facing -y.
*/
Hand MakePair(const Vector3d& axis, double turn, double range) {
  Hand hand;
  hand.links.resize(3);
  for (int k : {0, 1}) {
    HandLink& link = hand.links[static_cast<size_t>(k + 1)];
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
