#include "datasets/plan/imperfection_config.h"

#include <gtest/gtest.h>

#include <cstring>

#include "core/base/error.h"
#include "core/hand/load_hand.h"
#include "datasets/plan/session_plan.h"
#include "tests/datasets/session/fake_session.h"

namespace graspbench {
namespace {

TEST(ImperfectionConfigTest, EachOptionChangesItsNumbersAlone) {
  const Hand plain = LoadHand("tum");
  ImperfectionConfig config;
  config.hysteresis = 0.07;
  config.stick_slip = 0.1;
  config.stiffness_scale = 0.5;
  config.coupling_compliance = 0.4;
  Hand hand = plain;
  ApplyImperfections(config, hand);
  for (size_t j = 0; j < hand.joints.size(); ++j) {
    const JointDrive &drive = hand.joints[j].drive, &before = plain.joints[j].drive;
    const bool is_coupled = plain.joints[j].coupled_to >= 0;
    EXPECT_EQ(drive.stiffness, 0.5 * before.stiffness);
    EXPECT_EQ(drive.damping, before.damping);
    EXPECT_EQ(drive.torque_limit, before.torque_limit);
    EXPECT_EQ(drive.hysteresis_width, is_coupled ? 0.0 : 0.07);
    EXPECT_EQ(drive.friction_static, is_coupled ? 0.0 : 0.1 * before.torque_limit);
    EXPECT_EQ(drive.friction_dynamic, 0.6 * drive.friction_static);
    EXPECT_EQ(hand.joints[j].coupling_compliance, is_coupled ? 0.4 : 0.0);
  }
}

TEST(ImperfectionConfigTest, WhatConcernsNoJointIsRefused) {
  ImperfectionConfig yields;
  yields.coupling_compliance = 0.4;
  ImperfectionConfig loop;
  loop.hysteresis = 0.07;
  Hand hand = LoadHand("tum");
  for (HandJoint& joint : hand.joints) joint.coupled_to = -1;
  Hand slides = hand;
  for (HandJoint& joint : slides.joints) joint.is_prismatic = true;
  ApplyImperfections(loop, hand);
  for (const auto& [config, which] : {std::pair(yields, &hand), std::pair(loop, &slides)}) {
    try {
      ApplyImperfections(config, *which);
      ADD_FAILURE();
    } catch (const Error& e) {
      EXPECT_EQ(e.kind(), ErrorKind::kUsage);
      EXPECT_NE(std::string(e.what()).find("concerns nothing of the hand \"tum\""),
                std::string::npos)
          << e.what();
    }
  }
}

// None is what it was before there were any: the same configuration, the same ids.
TEST(ImperfectionConfigTest, NoneLeavesConfigurationAndIdsAsTheyWere) {
  SessionConfig config;
  EXPECT_FALSE(ToJson(config).contains("imperfections"));
  ApplySetting("imperfections.stiffness_scale=0.5", config);
  const Json json = ToJson(config);
  EXPECT_EQ(json.at("imperfections").at("stiffness_scale"), 0.5);
  EXPECT_EQ(json.at("imperfections").at("stick_slip"), 0.0);
  EXPECT_TRUE(SessionConfigFromJson(json).imperfections == config.imperfections);
  const SessionInputs inputs = MakeFakeInputs();
  const std::vector<PlannedTrial> plain = MakePlan(SessionConfig(), inputs),
                                  changed = MakePlan(config, inputs);
  ASSERT_EQ(plain.size(), changed.size());
  for (size_t i = 0; i < plain.size(); ++i) {
    EXPECT_NE(plain[i].id, changed[i].id);
    EXPECT_EQ(
        MakeTrialDraw(SessionConfig(), *inputs.hands[0].hand, *inputs.objects[0], 1).joint_error,
        MakeTrialDraw(config, *inputs.hands[0].hand, *inputs.objects[0], 1).joint_error);
  }
}

TEST(ImperfectionConfigTest, OutOfRangeIsRefusedWithWhatIsExpected) {
  for (const char* setting :
       {"imperfections.hysteresis_rad=-0.1", "imperfections.stick_slip=1",
        "imperfections.stiffness_scale=0", "imperfections.coupling_compliance_rad_per_nm=11"}) {
    SessionConfig config;
    ApplySetting(setting, config);
    try {
      CheckSessionConfig(config);
      ADD_FAILURE() << setting;
    } catch (const Error& e) {
      const std::string text = e.what(), key(setting, std::strchr(setting, '='));
      EXPECT_NE(text.find(key), std::string::npos) << text;
      EXPECT_NE(text.find("is out of range; expected 0"), std::string::npos) << text;
    }
  }
}

}  // namespace
}  // namespace graspbench
