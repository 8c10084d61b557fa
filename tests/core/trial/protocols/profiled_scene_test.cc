#include "core/trial/protocols/profiled_scene.h"

#include <gtest/gtest.h>

#include "core/hand/load_hand.h"
#include "core/physics/known_answers/small_scenes.h"

namespace graspbench {
namespace {

FreeSpaceProfile MakeGiven() {
  FreeSpaceProfile profile;
  profile.drives.law = "given";
  profile.drives.free_distal = true;
  profile.surfaces.pads = "given";
  profile.surfaces.torsion_radius = 0.03;
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
      continue;
    }
    EXPECT_EQ(joint.drive.stiffness, profile.drives.stiffness) << joint.name;
    EXPECT_EQ(joint.drive.torque_limit, profile.drives.torque_limit) << joint.name;
    EXPECT_EQ(joint.drive.friction_static, profile.drives.friction) << joint.name;
  }
  for (const HandLink& link : profiled->links) {
    EXPECT_EQ(link.surface.torsion_radius, 0.03);
    EXPECT_EQ(link.surface.pad.youngs_modulus, 0.0);
  }
}

TEST(ProfiledScene, AnUnstatedLimitOfTorqueIsTheHands) {
  const Hand hand = LoadHand("shadow");
  FreeSpaceProfile profile = MakeGiven();
  profile.drives.torque_limit = 0.0;
  const auto profiled =
      MakeProfiledHand(hand, profile, std::vector<bool>(hand.joints.size(), true));
  const auto limit_of = [](const Hand& of, const char* joint) {
    return of.joints[static_cast<size_t>(of.FindJoint(joint))].drive.torque_limit;
  };
  EXPECT_EQ(limit_of(*profiled, "FFJ3"), limit_of(hand, "FFJ3"));
  EXPECT_EQ(limit_of(*profiled, "FFJ1"), limit_of(hand, "FFJ2")) << "which moves it on the hand";
}

TEST(ProfiledScene, AProfileChoosesAmongTheStages) {
  const auto hand = std::make_shared<const Hand>(MakeBareHand());
  const auto object = std::make_shared<const GraspObject>(MakeBlock(0.1));
  std::vector<ScriptedStage> stages;
  for (const char* name : {"pregrasp", "grasp", "squeeze"}) {
    stages.push_back({name, Pose::Identity(), Eigen::VectorXd()});
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

TEST(ProfiledScene, OwnDrivesStayTheHands) {
  const Hand hand = LoadHand("shadow");
  const auto profiled =
      MakeProfiledHand(hand, FreeSpaceProfile(), std::vector<bool>(hand.joints.size(), true));
  for (size_t j = 0; j < hand.joints.size(); ++j) {
    EXPECT_EQ(profiled->joints[j].coupled_to, hand.joints[j].coupled_to);
    EXPECT_EQ(profiled->joints[j].drive.stiffness, hand.joints[j].drive.stiffness);
  }
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
  ScriptedStage stage{"grasp", Pose::Identity(), Eigen::VectorXd::Zero(hand->num_joints())};
  stage.q[hand->FindJoint("FFJ1")] = 0.8;
  stage.q[hand->FindJoint("FFJ2")] = 0.6;
  stage.q[hand->FindJoint("MFJ1")] = 0.2;
  stage.q[hand->FindJoint("MFJ2")] = 0.6;
  const ProfiledScene scene =
      MakeProfiledScene(hand, object, Pose::Identity(), {stage}, FreeSpaceProfile());
  const Eigen::VectorXd& q = scene.stages.front().q;
  EXPECT_NEAR(q[hand->FindJoint("FFJ1")], 0.7, 1e-12);
  EXPECT_NEAR(q[hand->FindJoint("FFJ2")], 0.7, 1e-12);
  EXPECT_EQ(q[hand->FindJoint("MFJ1")], 0.2);
  EXPECT_EQ(q[hand->FindJoint("MFJ2")], 0.6);
}

}  // namespace
}  // namespace graspbench
