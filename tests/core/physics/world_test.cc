#include "core/physics/world.h"

#include <gtest/gtest.h>

namespace graspbench {
namespace {

// A pad that stands still can be at its limit, by its torsion: it does not slide.
TEST(World, AContactSlidesOnlyWhereItsSurfacesMove) {
  HandContact contact;
  contact.slip_speed = 0.01;  // the bristle gives way
  EXPECT_STREQ(DescribeState(contact), "sticks");
  contact.is_at_limit = true;
  EXPECT_STREQ(DescribeState(contact), "slides");
  EXPECT_TRUE(IsSliding(contact));
  contact.slip_speed = 0.0005;
  EXPECT_STREQ(DescribeState(contact), "at its limit");
  EXPECT_FALSE(IsSliding(contact));
}

// Joint 1 follows joint 0: where the middle joint moves first, the drive acts on the sum of both,
// less what the coupling yields; under other rules and of linkages on the joint alone.
TEST(World, ADrivesPositionFollowsTheCoupling) {
  Hand hand;
  hand.joints.resize(2);
  hand.joints[1].coupled_to = 0;
  hand.coupling = CouplingRule::kMiddleFirst;
  WorldState state;
  state.q = Eigen::Vector2d(0.5, 0.2);
  EXPECT_DOUBLE_EQ(CalcDrivePosition(hand, state, 0), 0.7);
  state.deviation = Eigen::Vector2d(0.0, 0.05);
  EXPECT_DOUBLE_EQ(CalcDrivePosition(hand, state, 0), 0.65);
  hand.joints[1].is_mimic = true;
  EXPECT_EQ(CalcDrivePosition(hand, state, 0), 0.5);
  hand.joints[1].is_mimic = false;
  hand.coupling = CouplingRule::kEven;
  EXPECT_EQ(CalcDrivePosition(hand, state, 0), 0.5);
}

}  // namespace
}  // namespace graspbench
