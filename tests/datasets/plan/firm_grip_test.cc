#include "datasets/plan/firm_grip.h"

#include <gtest/gtest.h>

#include "core/base/config.h"
#include "core/base/error.h"
#include "datasets/plan/session_config.h"

namespace graspbench {
namespace {

// Frozen folders and ids of the time before say nothing of a grip, and must go on saying nothing.
TEST(FirmGripTest, AFirmGripIsNotWritten) {
  StrategyConfig firm;
  firm.grip = "posture";
  firm.touch_speed = 1.0;
  firm.grip_force = 3.3;  // a grip by posture does not look at it
  const Json json = StrategyToJson(firm);
  EXPECT_EQ(json.size(), 7u) << json.dump();
  for (const char* key : {"placing_time_s", "closure_time_s", "hold_time_s"}) {
    EXPECT_TRUE(json.contains(key)) << key;
  }
}

TEST(FirmGripTest, WhatSaysNothingIsFirm) {
  Json conditions = {{"strategy", StrategyToJson(MakePeopleGrip())}};
  for (const char* key : {"grip", "grip_force_n", "grip_margin", "touch_speed"}) {
    EXPECT_TRUE(conditions["strategy"].contains(key)) << "a grip that is not firm says so: " << key;
    conditions["strategy"].erase(key);
  }
  AddFirmGrip(conditions);
  EXPECT_EQ(conditions["strategy"]["grip"], "posture");
  EXPECT_EQ(conditions["strategy"]["touch_speed"], 1.0);
  EXPECT_EQ(conditions["strategy"].size(), ConfigToJson(StrategyConfig()).size());
  Json without = {{"sim", 1}};
  AddFirmGrip(without);
  EXPECT_FALSE(without.contains("strategy"));
}

TEST(FirmGripTest, WhatCannotMatterIsRefused) {
  StrategyConfig strategy;
  strategy.grip = "force";
  RefuseUnusedGrip("strategy.grip_force_n=2", strategy);
  RefuseUnusedGrip("model.mass_scale=2", strategy);
  EXPECT_THROW(RefuseUnusedGrip("strategy.grip_margin=2", strategy), Error);
  strategy.grip = "posture";
  EXPECT_THROW(RefuseUnusedGrip("strategy.grip_force_n=2", strategy), Error);
}

TEST(FirmGripTest, ARegulatedGripComesBackAsItWas) {
  SessionConfig config;
  config.strategy.grip = "margin";
  config.strategy.grip_margin = 1.5;
  config.strategy.grip_force = 0.0;
  config.strategy.touch_speed = 0.25;
  const SessionConfig back = SessionConfigFromJson(ToJson(config));
  EXPECT_EQ(ToJson(back), ToJson(config));
  EXPECT_EQ(back.strategy.grip_margin, 1.5);
}

}  // namespace
}  // namespace graspbench
