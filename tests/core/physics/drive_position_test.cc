#include "core/physics/drive_position.h"

#include <gtest/gtest.h>

namespace graspbench {
namespace {

/** Joint 1 follows joint 0. */
Hand MakeCoupledHand(CouplingRule rule) {
  Hand hand;
  hand.joints.resize(2);
  hand.joints[1].coupled_to = 0;
  hand.coupling = rule;
  return hand;
}

WorldState MakeState() {
  WorldState state;
  state.q = Eigen::Vector2d(0.5, 0.2);
  return state;
}

TEST(DrivePosition, IsTheWayOfBothWhereTheMiddleJointMovesFirst) {
  EXPECT_DOUBLE_EQ(CalcDrivePosition(MakeCoupledHand(CouplingRule::kMiddleFirst), MakeState(), 0),
                   0.7);
}

TEST(DrivePosition, DoesNotCountWhatACouplingYields) {
  WorldState state = MakeState();
  state.deviation = Eigen::Vector2d(0.0, 0.05);
  EXPECT_DOUBLE_EQ(CalcDrivePosition(MakeCoupledHand(CouplingRule::kMiddleFirst), state, 0), 0.65);
}

TEST(DrivePosition, IsTheJointsOwnUnderOtherRulesAndForLinkages) {
  for (const CouplingRule rule : {CouplingRule::kEven, CouplingRule::kFixed}) {
    EXPECT_EQ(CalcDrivePosition(MakeCoupledHand(rule), MakeState(), 0), 0.5);
  }
  Hand linkage = MakeCoupledHand(CouplingRule::kMiddleFirst);
  linkage.joints[1].is_mimic = true;
  EXPECT_EQ(CalcDrivePosition(linkage, MakeState(), 0), 0.5);
}

}  // namespace
}  // namespace graspbench
