#include "core/develop/posture_rules.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/base/units.h"
#include "core/grasp/placement.h"
#include "core/hand/closing.h"
#include "core/hand/load_hand.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;

class PostureRulesTest : public testing::Test {
 protected:
  PostureRulesTest() : hand_(LoadHand("tum")) {
    aim_.digits = {"TH", "FF", "MF"};
    // Straight fingers: pads 80 mm less twice 7 mm apart, 93 mm above the palm.
    aim_.opening = aim_.meeting = 0.066;
    aim_.reach = 0.05;
    aim_.pad_gap = 0.04;
    pair_.q_open = pair_.q_met = VectorXd::Zero(hand_.num_joints());
  }
  VectorXd CalcResiduals(const PosturePair& pair) const {
    const PostureRules rules(hand_, aim_, VectorXd::Zero(hand_.num_joints()));
    const VectorXd residuals = rules.CalcResiduals(rules.MakeCoordinates(pair));
    EXPECT_EQ(residuals.size(), rules.num_residuals());
    return residuals;
  }

  Hand hand_;
  PostureAim aim_;
  PosturePair pair_;
};

// Straight fingers of the TUM Hand are level, face each other, and stand in line: nothing is missed
// but the thumb's share of a way of zero length.
TEST_F(PostureRulesTest, StraightTumFingersKeepTheRules) {
  EXPECT_LT(CalcResiduals(pair_).norm(), 0.15);
}

TEST_F(PostureRulesTest, EachRuleIsMissedByItself) {
  const double kept = CalcResiduals(pair_).norm();
  const auto calc_with = [&](void (*change)(PostureAim&)) {
    const PostureAim before = aim_;
    change(aim_);
    const double miss = CalcResiduals(pair_).norm();
    aim_ = before;
    return miss;
  };
  // 15 mm in each of the three postures, of 5 mm that matter; the share asks for its part of a way.
  EXPECT_NEAR(calc_with([](PostureAim& aim) { aim.opening = aim.meeting = 0.081; }),
              std::sqrt(3.0) * 3.0, 0.1);
  EXPECT_GT(calc_with([](PostureAim& aim) { aim.reach = 0.12; }), kept + 3.0);
  EXPECT_GT(calc_with([](PostureAim& aim) { aim.tips_down = 1.2; }), kept + 1.0);
  EXPECT_GT(calc_with([](PostureAim& aim) { aim.pad_gap = 0.06; }), kept + 3.0);
  EXPECT_GT(calc_with([](PostureAim& aim) { aim.lift = RadFromDeg(40.0); }), kept + 2.0);
}

// Index and middle with their sides: straight they stand level and face each other along y.
TEST_F(PostureRulesTest, SidesOfNeighboursFaceEachOther) {
  aim_.digits = {"FF", "MF"};
  aim_.pad_gap = 0.0;
  const auto calc_sides = [&] {
    const auto X_HL = CalcLinkPoses(hand_, pair_.q_open);
    const Vector3d apart = CalcSideState(hand_, hand_.digits[0], 1.0, X_HL).p_HPad -
                           CalcSideState(hand_, hand_.digits[1], 1.0, X_HL).p_HPad;
    return apart;
  };
  double radius = 0.0;
  for (const ContactSphere& ball : hand_.contact_spheres) {
    if (ball.link == hand_.digits[0].distal_link) radius = std::max(radius, ball.radius);
  }
  // The same side of both, so the axes are as far apart; facing sides less a radius each.
  aim_.opening = aim_.meeting = calc_sides().norm() - 2.0 * radius;
  const double by_pads = CalcResiduals(pair_).norm();
  aim_.by_side = true;
  // Nothing is missed but that the straight thumb reaches 8 mm below the pads, in each posture, of
  // 8 mm that it is to stay above them, of 5 mm that matter.
  const double by_sides = CalcResiduals(pair_).norm();
  EXPECT_NEAR(by_sides, std::sqrt(3.0) * 16.0 / 5.0, 0.1);
  EXPECT_GT(by_pads, by_sides + 1.0);
}

TEST_F(PostureRulesTest, CoordinatesAreSharesOfTheRanges) {
  const PostureRules rules(hand_, aim_, VectorXd::Zero(hand_.num_joints()));
  PosturePair pair = pair_;
  pair.q_open = CalcClosedPosture(hand_, FindClosing(hand_), 0.3);
  pair.q_met = CalcClosedPosture(hand_, FindClosing(hand_), 0.6);
  pair.tilt = 0.1;
  const VectorXd x = rules.MakeCoordinates(pair);
  EXPECT_GE(x.head(x.size() - 1).minCoeff(), 0.0);
  EXPECT_LE(x.head(x.size() - 1).maxCoeff(), 1.0);
  const PosturePair back = rules.MakePair(x);
  EXPECT_LT((back.q_open - pair.q_open).norm() + (back.q_met - pair.q_met).norm(), 1e-12);
  EXPECT_EQ(back.tilt, 0.1);
  // Outside of its limits a joint stays at them.
  VectorXd outside = x;
  outside[0] = 2.0;
  const PosturePair limited = rules.MakePair(outside);
  for (int j = 0; j < hand_.num_joints(); ++j) {
    EXPECT_LE(limited.q_open[j], hand_.joints[j].upper + 1e-12);
  }
}

}  // namespace
}  // namespace graspbench
