#include "core/hand/import/checks/outward_digits.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "core/base/units.h"

namespace graspbench {
namespace {

/** Three fingers of one joint about a hub, 50 mm long along z, that bend to its axis; the second by
`sign`. */
Hand MakeThree(double sign, double lower, double upper) {
  Hand hand;
  hand.links.resize(1);
  for (int i = 0; i < 3; ++i) {
    const double angle = 2.0 * kPi / 3.0 * i;
    HandLink link;
    link.parent = 0;
    link.joint = i;
    link.X_PJ = MakePose(MakeRotationRpy(0, 0, angle),
                         Eigen::Vector3d(0.05 * std::cos(angle), 0.05 * std::sin(angle), 0.02));
    link.axis = -(i == 1 ? sign : 1.0) * Eigen::Vector3d::UnitY();
    HandJoint joint;
    joint.link = i + 1;
    joint.lower = lower;
    joint.upper = upper;
    Digit digit;
    digit.links = {i + 1};
    digit.distal_link = i + 1;
    digit.p_LTip = {0, 0, 0.05};
    digit.p_LPad = {-0.005, 0, 0.04};
    hand.links.push_back(link);
    hand.joints.push_back(joint);
    hand.digits.push_back(digit);
  }
  return hand;
}

TEST(OutwardDigitsTest, ADigitThatBendsAwayFromTheOthers) {
  EXPECT_EQ(FindOutwardDigits(MakeThree(1.0, 0.0, 1.5)), std::vector<bool>({false, false, false}));
  EXPECT_EQ(FindOutwardDigits(MakeThree(-1.0, 0.0, 1.5)), std::vector<bool>({false, true, false}));
}

// Which way a joint closes is not known where its limits are the same to both sides.
TEST(OutwardDigitsTest, ADigitThatNothingClosesIsNone) {
  EXPECT_EQ(FindOutwardDigits(MakeThree(-1.0, -1.0, 1.0)),
            std::vector<bool>({false, false, false}));
}

}  // namespace
}  // namespace graspbench
