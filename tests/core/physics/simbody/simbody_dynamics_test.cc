#include "core/physics/simbody/simbody_dynamics.h"

#include <gtest/gtest.h>

#include "core/hand/load_hand.h"
#include "core/physics/known_answers/small_scenes.h"

namespace graspbench {
namespace {

class CompareWithSimbodyTest : public testing::TestWithParam<const char*> {};

// A finger that is one in a thousand heavier than the one simulated is noticed, however heavy the
// base; the hand itself is not told apart from Simbody's.
TEST_P(CompareWithSimbodyTest, NoticesAWrongFingertip) {
  const Hand hand = LoadHand(GetParam());
  const GraspObject block = MakeBlock(0.5);
  SmallWorld world(hand, block, SimConfig());
  world.Reset(Eigen::VectorXd::Constant(hand.num_joints(), 0.2));
  for (int i = 0; i < 5; ++i) world.Step();
  SimbodyModel same(hand, block.mass_properties);
  EXPECT_LT(CompareWithSimbody(world.world(), same), kSimbodyTolerance);

  Hand heavier = hand;
  heavier.links.back().mass *= 1.001;
  SimbodyModel other(heavier, block.mass_properties);
  EXPECT_GT(CompareWithSimbody(world.world(), other), 1e3 * kSimbodyTolerance);
}

INSTANTIATE_TEST_SUITE_P(Hands, CompareWithSimbodyTest, testing::Values("tum", "shadow"));

// Slides that lie level are not pulled by gravity: at rest both biases are nothing but rounding.
TEST(CompareWithSimbody, LevelSlidesWithoutBiasAreNoDifference) {
  Hand hand = LoadHand("tum");
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(hand.num_joints());
  const GraspObject block = MakeBlock(0.5);
  SmallWorld turning(hand, block, SimConfig());
  turning.Reset(zero);
  const Eigen::Matrix3d R_WH = turning.world().state().X_WH.linear();
  const std::vector<Pose> X_HL = CalcLinkPoses(hand, zero);
  for (HandLink& link : hand.links) {
    if (link.joint < 0) continue;
    const Eigen::Matrix3d R_HJ =
        X_HL[static_cast<size_t>(link.parent)].linear() * link.X_PJ.linear();
    link.axis = (R_WH * R_HJ).transpose() * Eigen::Vector3d::UnitX();
    hand.joints[static_cast<size_t>(link.joint)].is_prismatic = true;
  }
  SmallWorld sliding(hand, block, SimConfig());
  sliding.Reset(zero);
  SimbodyModel simbody(hand, block.mass_properties);
  EXPECT_LT(CompareWithSimbody(sliding.world(), simbody), kSimbodyTolerance);
}

}  // namespace
}  // namespace graspbench
