#include "core/trial/protocols/free_space_profile.h"

#include <gtest/gtest.h>

#include "core/hand/load_hand.h"
#include "core/physics/known_answers/small_scenes.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;

FreeSpaceProfile MakeGiven() {
  FreeSpaceProfile profile;
  profile.drives.law = "given";
  profile.drives.free_distal = true;
  profile.drives.armature = 2e-4;
  profile.surfaces.pads = "given";
  profile.surfaces.torsion_radius = 0.03;
  profile.surfaces.relaxation_time = 0.024;
  profile.surfaces.friction = 0.6;
  profile.mass = 0.2;
  return profile;
}

TEST(ProfiledScene, GivenDrivesMoveEveryJointOfItsOwn) {
  const Hand hand = LoadHand("shadow");
  std::vector<bool> is_asked(hand.joints.size(), true);
  is_asked[static_cast<size_t>(hand.FindJoint("WRJ1"))] = false;
  const FreeSpaceProfile profile = MakeGiven();
  const auto profiled = MakeProfiledHand(hand, profile, is_asked);
  for (const HandJoint& joint : profiled->joints) {
    EXPECT_EQ(joint.coupled_to, -1) << joint.name;
    if (joint.name == "WRJ1") {
      EXPECT_EQ(joint.drive.stiffness, profile.sim.arm_angular_stiffness);
      EXPECT_EQ(joint.drive.armature, 0.0);
      continue;
    }
    EXPECT_EQ(joint.drive.stiffness, profile.drives.stiffness) << joint.name;
    EXPECT_EQ(joint.drive.torque_limit, profile.drives.torque_limit) << joint.name;
    EXPECT_EQ(joint.drive.friction_static, profile.drives.friction) << joint.name;
    EXPECT_EQ(joint.drive.armature, profile.drives.armature) << joint.name;
  }
  for (const HandLink& link : profiled->links) {
    EXPECT_EQ(link.surface.torsion_radius, 0.03);
    EXPECT_EQ(link.surface.relaxation_time, 0.024);
    EXPECT_EQ(link.surface.pad.youngs_modulus, 0.0);
  }
}

TEST(ProfiledScene, AnUnstatedLimitOfTorqueIsTheHands) {
  const Hand hand = LoadHand("shadow");
  FreeSpaceProfile profile = MakeGiven();
  profile.drives.torque_limit = 0.0;
  const auto profiled =
      MakeProfiledHand(hand, profile, std::vector<bool>(hand.joints.size(), true));
  const auto distal = static_cast<size_t>(hand.FindJoint("FFJ1"));
  const auto middle = static_cast<size_t>(hand.FindJoint("FFJ2"));  // moves it on the hand
  EXPECT_EQ(profiled->joints[distal].drive.torque_limit, hand.joints[middle].drive.torque_limit);
}

TEST(ProfiledScene, AProfileChoosesAmongTheStages) {
  const auto hand = std::make_shared<const Hand>(MakeBareHand());
  const auto object = std::make_shared<const GraspObject>(MakeBlock(0.1));
  std::vector<ScriptedStage> stages;
  for (const char* name : {"pregrasp", "grasp", "squeeze"}) {
    stages.push_back({name, Pose::Identity(), VectorXd()});
  }
  const auto choose = [&](const char* choice) {
    FreeSpaceProfile profile;
    profile.closing.stages = choice;
    std::string names;
    for (const ScriptedStage& stage :
         MakeProfiledScene(hand, object, Pose::Identity(), stages, profile).stages) {
      names += stage.name + " ";
    }
    return names;
  };
  EXPECT_EQ(choose("all"), "pregrasp grasp squeeze ");
  EXPECT_EQ(choose("first"), "pregrasp ");
  EXPECT_EQ(choose("grasp"), "grasp ");
  stages[1].name = "hold";
  EXPECT_EQ(choose("grasp"), "squeeze ");
}

TEST(ProfiledScene, TheObjectGetsMassAndFriction) {
  const GraspObject block = MakeBlock(0.1);
  FreeSpaceProfile profile = MakeGiven();
  const auto given = MakeProfiledObject(block, profile);
  EXPECT_EQ(given->mass_properties.mass, 0.2);
  EXPECT_TRUE(given->mass_properties.I_OOcm.isApprox(2.0 * block.mass_properties.I_OOcm));
  EXPECT_EQ(given->surface.friction_static, 0.6);
  EXPECT_EQ(given->surface.friction_dynamic, 0.6);
  profile.mass = 0.0;
  profile.density = 500.0;  // 60 x 40 x 20 mm
  EXPECT_NEAR(MakeProfiledObject(block, profile)->mass_properties.mass, 0.024, 1e-9);
}

TEST(ProfiledScene, AStageThatBendsTheDistalJointMoreIsEvened) {
  const auto hand = std::make_shared<const Hand>(LoadHand("shadow"));
  const auto object = std::make_shared<const GraspObject>(MakeBlock(0.1));
  ScriptedStage stage{"grasp", Pose::Identity(), VectorXd::Zero(hand->num_joints())};
  stage.q[hand->FindJoint("FFJ1")] = 0.8;
  stage.q[hand->FindJoint("FFJ2")] = 0.6;
  stage.q[hand->FindJoint("MFJ1")] = 0.2;
  stage.q[hand->FindJoint("MFJ2")] = 0.6;
  const ProfiledScene scene =
      MakeProfiledScene(hand, object, Pose::Identity(), {stage}, FreeSpaceProfile());
  const VectorXd& q = scene.stages.front().q;
  EXPECT_NEAR(q[hand->FindJoint("FFJ1")], 0.7, 1e-12);
  EXPECT_NEAR(q[hand->FindJoint("FFJ2")], 0.7, 1e-12);
  EXPECT_EQ(q[hand->FindJoint("MFJ1")], 0.2);
  EXPECT_EQ(q[hand->FindJoint("MFJ2")], 0.6);
}

constexpr double kBlockHalfWidth = 0.03;

/** Balls on the block's +x and -x sides at the end of levers that a joint turns. */
ProfiledScene MakePinch(double shift, const FreeSpaceProfile& profile) {
  const auto hand = std::make_shared<const Hand>(MakeSqueezeHand(2, kBlockHalfWidth, 1.0, 0.0));
  const auto object = std::make_shared<const GraspObject>(MakeBlock(0.1));
  const ScriptedStage stage{"grasp", MakePose(Vector3d(shift, 0.0, kSqueezeLever)),
                            VectorXd::Zero(2)};
  return MakeProfiledScene(hand, object, Pose::Identity(), {stage}, profile);
}

// A ball on a lever moves by the lever's length per radian, straight into the face.
TEST(ClosingStage, PressTurnsByHowFarAPointWouldMove) {
  FreeSpaceProfile profile;
  EXPECT_EQ(CalcClosingCommand(MakePinch(0.0, profile), profile), VectorXd::Zero(2)) << "stated";
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
