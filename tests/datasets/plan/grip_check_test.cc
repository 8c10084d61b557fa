#include "datasets/plan/grip_check.h"

#include <gtest/gtest.h>

#include "core/base/config.h"
#include "core/base/error.h"
#include "datasets/plan/session_config.h"
#include "datasets/plan/session_plan.h"
#include "tests/datasets/find_error.h"

namespace graspbench {

namespace {

SessionConfig MakeConfig(const std::string& grip, double force) {
  SessionConfig config;
  config.hands = {"tum"};
  config.objects = {"toy_cube"};
  config.strategy.grip = grip;
  config.strategy.grip_force = force;
  return config;
}
std::string FindRefusal(const SessionConfig& config) {
  try {
    MakePlan(config, LoadSessionInputs(config));
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::kRange);
    return error.what();
  }
  return "";
}

std::vector<std::string> ListWarnings(const SessionConfig& config) {
  return ListGripWarnings(config, LoadSessionInputs(config));
}

// 900 N at the fingertip of the TUM Hand, 80 mm from its knuckle, would take 72 N m; its drives give
// 1 N m.
TEST(GripCheckTest, AForceThatNoDriveGivesIsRefusedWithTheLargest) {
  const std::string text = FindRefusal(MakeConfig("force", 900.0));
  EXPECT_TRUE(Has(text, "cannot press with 900.00 N"));
  EXPECT_TRUE(Has(text, "the torque limits of its drives allow at most "));
  EXPECT_EQ(FindRefusal(MakeConfig("force", 2.0)), "");
  EXPECT_EQ(FindRefusal(MakeConfig("posture", 900.0)), "");  // nobody looks at it
}

// A threshold of 10 % of a linear element of 10 N is 1 N, more than the 0.7 N that are asked.
TEST(GripCheckTest, WhatNoElementFeelsIsRefused) {
  SessionConfig config = MakeConfig("force", 0.7);
  config.hands = {"shadow"};
  config.touch = "sensed";
  EXPECT_EQ(FindRefusal(config), "");
  EXPECT_TRUE(ListWarnings(config).empty());
  config.sensors.force_scale = 1e3;  // so long an exponential is a line
  config.sensors.threshold = 0.1;
  const std::string text = FindRefusal(config);
  EXPECT_TRUE(Has(text, "\"shadow\" is 1.00 N, but the setpoint of each digit is 0.70 N"));
  config.strategy.grip_force = 1.1;
  EXPECT_EQ(FindRefusal(config), "");
  config.strategy.grip = "margin";  // which may ask for more
  config.strategy.grip_force = 0.7;
  EXPECT_EQ(FindRefusal(config), "");
  ASSERT_EQ(ListWarnings(config).size(), 1u);
  EXPECT_TRUE(Has(ListWarnings(config)[0], "the minimum setpoint of a digit is 0.70 N"));
}

TEST(GripCheckTest, SaturatedElementsAreNamed) {
  SessionConfig config = MakeConfig("force", 2.0);
  config.hands = {"shadow"};
  config.touch = "sensed";
  config.sensors.saturation = 1.5;
  EXPECT_EQ(FindRefusal(config), "") << "several elements feel more";
  ASSERT_EQ(ListWarnings(config).size(), 1u);
  EXPECT_TRUE(Has(ListWarnings(config)[0], "measures at most 1.50 N"));
  config.sensors.saturation = 0.01;
  EXPECT_TRUE(Has(FindRefusal(config), "the setpoint of each digit is 2.00 N, but the "));
  config.touch = "exact";
  config.sensors = {};
  EXPECT_EQ(FindRefusal(config), "");
}

// A level of a sweep is refused as a session of it would be.
TEST(GripCheckTest, ConditionsAreAskedToo) {
  SessionConfig config = MakeConfig("force", 2.0);
  config.conditions = {{"strong", {"strategy.grip_force_n=900"}}};
  EXPECT_TRUE(Has(FindRefusal(config), "cannot press with 900.00 N"));
}

TEST(GripCheckTest, AMarginNeedsFriction) {
  SessionConfig config = MakeConfig("margin", 0.0);
  EXPECT_EQ(FindRefusal(config), "");
  config.model.friction_scale = 0.0;
  EXPECT_TRUE(Has(FindRefusal(config), "a margin needs friction"));
  config.strategy.grip = "force";
  config.strategy.grip_force = 1.0;
  EXPECT_EQ(FindRefusal(config), "");
  config.conditions = {{"by margin", {"strategy.grip=margin"}}};
  EXPECT_TRUE(Has(FindRefusal(config), "a margin needs friction"));
}

}  // namespace

}  // namespace graspbench
