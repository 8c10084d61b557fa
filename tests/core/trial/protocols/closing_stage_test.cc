#include "core/trial/protocols/closing_stage.h"

#include <gtest/gtest.h>

#include "core/hand/load_hand.h"
#include "core/physics/known_answers/small_scenes.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr double kBlockHalfWidth = 0.03;

/** Balls on the block's +x and -x sides at the end of levers that a joint turns. */
ProfiledScene MakePinch(double shift, const FreeSpaceProfile& profile) {
  const auto hand = std::make_shared<const Hand>(MakeSqueezeHand(2, kBlockHalfWidth, 1.0, 0.0));
  const auto object = std::make_shared<const GraspObject>(MakeBlock(0.1));
  const ScriptedStage stage{"grasp", MakePose(Vector3d(shift, 0.0, kSqueezeLever)),
                            VectorXd::Zero(2)};
  return MakeProfiledScene(hand, object, Pose::Identity(), {stage}, profile);
}

TEST(ClosingStage, StatedIsWhatTheStageSays) {
  const FreeSpaceProfile profile;
  EXPECT_EQ(CalcClosingCommand(MakePinch(0.0, profile), profile), VectorXd::Zero(2));
}

// A ball on a lever moves by the lever's length per radian, straight into the face.
TEST(ClosingStage, PressTurnsByHowFarAPointWouldMove) {
  FreeSpaceProfile profile;
  profile.closing.to = "press";
  for (const double press : {1.0, 2.0}) {
    profile.closing.press = press;
    const VectorXd q = CalcClosingCommand(MakePinch(0.0, profile), profile);
    EXPECT_NEAR(q[0], press * kSqueezeLever, 1e-4);
    EXPECT_NEAR(q[1], press * kSqueezeLever, 1e-4);
  }
  // Two millimetres off is out of reach; what is inside presses.
  profile.closing.press = 1.0;
  const VectorXd q = CalcClosingCommand(MakePinch(0.002, profile), profile);
  EXPECT_EQ(q[0], 0.0);
  EXPECT_NEAR(q[1], kSqueezeLever, 1e-4);
}

TEST(ClosingStage, LimitsAreTheClosedEndsOfWhatBends) {
  FreeSpaceProfile profile;
  profile.closing.to = "limits";
  const auto hand = std::make_shared<const Hand>(LoadHand("shadow"));
  const auto object = std::make_shared<const GraspObject>(MakeBlock(0.1));
  const ScriptedStage stage{"grasp", Pose::Identity(), VectorXd::Zero(hand->num_joints())};
  const ProfiledScene scene = MakeProfiledScene(hand, object, Pose::Identity(), {stage}, profile);
  const VectorXd q = CalcClosingCommand(scene, profile);
  for (const char* bends : {"FFJ3", "FFJ2", "LFJ3"}) {
    const int joint = hand->FindJoint(bends);
    EXPECT_EQ(q[joint], hand->joints[static_cast<size_t>(joint)].upper) << bends;
  }
  for (const char* other : {"FFJ4", "RFJ4", "WRJ1"}) {
    EXPECT_EQ(q[hand->FindJoint(other)], 0.0) << other;
  }
}

}  // namespace
}  // namespace graspbench
