#include "core/trial/grip/grip_limit.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/physics/known_answers/small_scenes.h"

namespace graspbench {
namespace {

// Two rods of 0.1 m, drives of 2 N m and 0.5 N m: the weaker one that does not oppose decides.
TEST(CalcLargestGrip, OfRodsIsTorqueOverLength) {
  Hand hand = MakeBareHand();
  Grasp grasp;
  for (const char* id : {"TH", "FF"}) {
    AddRodLink(hand, 0, Pose::Identity(), Eigen::Vector3d::UnitY(), 0.02, 0.1);
    hand.joints.back().drive = {1.0, 0.02, id[0] == 'T' ? 0.5 : 2.0};
    Digit digit;
    digit.id = id;
    digit.is_thumb = id[0] == 'T';
    digit.links = {static_cast<int>(hand.links.size()) - 1};
    digit.distal_link = digit.links.front();
    digit.p_LPad = Eigen::Vector3d(0.0, 0.0, 0.1);
    hand.digits.push_back(digit);
    grasp.digits.push_back(id);
  }
  grasp.q_pre = Eigen::Vector2d(0.0, 0.0);
  grasp.q_target = Eigen::Vector2d(0.3, -0.3);
  EXPECT_NEAR(CalcLargestGrip(hand, grasp), 2.0 / 0.1, 1e-9);
  grasp.q_target = Eigen::Vector2d(0.3, 0.0);  // the finger does not close
  EXPECT_TRUE(std::isinf(CalcLargestGrip(hand, grasp)));
}

}  // namespace
}  // namespace graspbench
