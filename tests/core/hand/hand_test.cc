#include "core/hand/hand.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "core/base/units.h"
#include "core/hand/load_hand.h"

namespace graspbench {
namespace {

TEST(HandTest, PeopleReadDegreesAndMillimetres) {
  HandJoint turn, slide;
  slide.is_prismatic = true;
  EXPECT_EQ(DisplayUnitOf(turn), std::string("deg"));
  EXPECT_EQ(DisplayUnitOf(slide), std::string("mm"));
  EXPECT_DOUBLE_EQ(ToDisplayUnits(turn, M_PI / 6.0), 30.0);
  EXPECT_DOUBLE_EQ(ToDisplayUnits(slide, 0.0125), 12.5);
  EXPECT_DOUBLE_EQ(FromDisplayUnits(turn, 30.0), M_PI / 6.0);
  EXPECT_DOUBLE_EQ(FromDisplayUnits(slide, 12.5), 0.0125);
}

constexpr double kUpper = RadFromDeg(90.0);

TEST(CouplingTest, RatesOfTheRules) {
  for (DistalMode mode : {DistalMode::kMiddleMoves, DistalMode::kDistalMoves}) {
    EXPECT_EQ(CalcDistalRates(CouplingRule::kEven, 0.8, mode).middle, 1.0);
    EXPECT_EQ(CalcDistalRates(CouplingRule::kEven, 0.8, mode).distal, 1.0);
    EXPECT_EQ(CalcDistalRates(CouplingRule::kFixed, 0.8, mode).middle, 1.0);
    EXPECT_EQ(CalcDistalRates(CouplingRule::kFixed, 0.8, mode).distal, 0.8);
  }
  const auto middle = CalcDistalRates(CouplingRule::kMiddleFirst, 0.8, DistalMode::kMiddleMoves);
  EXPECT_EQ(middle.middle, 1.0);
  EXPECT_EQ(middle.distal, 0.0);
  const auto distal = CalcDistalRates(CouplingRule::kMiddleFirst, 0.8, DistalMode::kDistalMoves);
  EXPECT_EQ(distal.middle, 0.0);
  EXPECT_EQ(distal.distal, 1.0);
}

/** Runs theta up and down in small steps, with the middle joint blocked while theta is between two
values on the way up; gives all (J2, J1) in order. */
std::vector<std::pair<double, double>> RunFinger(double theta_end, double blocked_from) {
  std::vector<std::pair<double, double>> course;
  double q_middle = 0.0, q_distal = 0.0;
  DistalMode mode = DistalMode::kMiddleMoves;
  const double step = RadFromDeg(0.1);
  const auto move = [&](double d_theta) {
    const bool is_blocked = d_theta > 0.0 && q_middle >= blocked_from;
    mode = FindDistalMode(q_middle, q_distal, kUpper, d_theta > 0.0, is_blocked, mode);
    const DistalRates rates = CalcDistalRates(CouplingRule::kMiddleFirst, 0.8, mode);
    q_middle += rates.middle * d_theta * (is_blocked && rates.middle > 0.0 ? 0.0 : 1.0);
    q_distal += rates.distal * d_theta;
    course.emplace_back(q_middle, q_distal);
  };
  const int num_steps = static_cast<int>(theta_end / step);
  for (int i = 0; i < num_steps; ++i) move(step);
  while (q_middle > 0.0 || q_distal > 0.0) move(-step);
  return course;
}

TEST(CouplingTest, MiddleFirstBendsTheDistalJointOnlyAtTheEndOfTheMiddleOne) {
  for (const auto& [middle, distal] : RunFinger(RadFromDeg(150.0), 10.0)) {
    if (distal > 0.0) {
      EXPECT_GE(middle, kUpper - RadFromDeg(1.01));
    }
    EXPECT_GE(middle, distal);
  }
}

TEST(CouplingTest, MiddleFirstWrapsAroundAnObjectThatBlocksTheMiddlePhalanx) {
  const double blocked = RadFromDeg(40.0);
  const auto course = RunFinger(RadFromDeg(70.0), blocked);
  double largest_distal = 0.0;
  for (const auto& [middle, distal] : course) {
    EXPECT_LE(middle, blocked + RadFromDeg(0.11));
    EXPECT_GE(middle + 1e-12, distal);
    largest_distal = std::max(largest_distal, distal);
  }
  EXPECT_NEAR(largest_distal, RadFromDeg(30.0), RadFromDeg(0.2));  // 70 = 40 + 30
}

TEST(CouplingTest, TheDistalAngleNeverExceedsTheMiddleOne) {
  for (const auto& [middle, distal] : RunFinger(RadFromDeg(100.0), RadFromDeg(20.0))) {
    EXPECT_LE(distal, middle + RadFromDeg(0.11));
  }
}

TEST(CouplingTest, OpeningUndoesTheDistalJointFirst) {
  EXPECT_EQ(FindDistalMode(1.0, 0.3, kUpper, false, false, DistalMode::kMiddleMoves),
            DistalMode::kDistalMoves);
  EXPECT_EQ(FindDistalMode(1.0, 0.0, kUpper, false, true, DistalMode::kDistalMoves),
            DistalMode::kMiddleMoves);
}

TEST(CouplingTest, AReleasedMiddleJointMovesAgain) {
  EXPECT_EQ(FindDistalMode(0.7, 0.3, kUpper, true, false, DistalMode::kDistalMoves),
            DistalMode::kMiddleMoves);
}

TEST(CouplingTest, ASpringyEndDoesNotMakeTheModeFlicker) {
  DistalMode mode = DistalMode::kMiddleMoves;
  int num_changes = 0;
  for (int i = 0; i < 100; ++i) {
    const double q_middle = kUpper - RadFromDeg(i % 2 ? 0.45 : 0.6);
    const DistalMode next = FindDistalMode(q_middle, 0.1, kUpper, true, false, mode);
    num_changes += next != mode;
    mode = next;
  }
  EXPECT_EQ(num_changes, 1);
}

TEST(CouplingTest, APostureFillsTheDistalJoints) {
  Hand hand = LoadHand("shadow");
  const int middle = hand.FindJoint("FFJ2"), distal = hand.FindJoint("FFJ1");
  Eigen::VectorXd q = Eigen::VectorXd::Zero(hand.num_joints());
  q[middle] = 1.0;
  q[distal] = 0.5;
  ApplyCoupling(hand, q);
  EXPECT_EQ(q[distal], 0.0);
  hand.coupling = CouplingRule::kEven;
  ApplyCoupling(hand, q);
  EXPECT_EQ(q[distal], 1.0);
  hand.coupling = CouplingRule::kFixed;
  ApplyCoupling(hand, q);
  EXPECT_EQ(q[distal], 0.8);
  EXPECT_EQ(q[middle], 1.0);
  hand.joints[distal].upper = 0.6;
  ApplyCoupling(hand, q);
  EXPECT_EQ(q[distal], 0.6);
}

}  // namespace
}  // namespace graspbench
