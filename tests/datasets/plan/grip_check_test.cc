#include "datasets/plan/grip_check.h"

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "datasets/plan/session_plan.h"

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

TEST(GripCheckTest, AForceThatNoDriveGivesIsRefusedWithTheLargest) {
  const std::string text = FindRefusal(MakeConfig("force", 900.0));
  EXPECT_NE(text.find("cannot press with 900.00 N"), std::string::npos) << text;
  EXPECT_NE(text.find("its drives give at most some "), std::string::npos) << text;
  EXPECT_EQ(FindRefusal(MakeConfig("force", 2.0)), "");
  EXPECT_EQ(FindRefusal(MakeConfig("posture", 900.0)), "");  // nobody looks at it
}

// The estimate is of pads; a power grasp presses with links nearer to the palm, so with more.
TEST(GripCheckTest, APowerGraspIsNotAskedForWhatItsPadsGive) {
  SessionConfig config = MakeConfig("force", 15.0);
  config.grasps = {"g1"};
  EXPECT_NE(FindRefusal(config).find("in the grasp g1"), std::string::npos);
  config.objects = {"can"};
  config.grasps = {"g3"};
  EXPECT_EQ(FindRefusal(config), "");
}

TEST(GripCheckTest, AMarginNeedsFriction) {
  SessionConfig config = MakeConfig("margin", 0.0);
  EXPECT_EQ(FindRefusal(config), "");
  config.model.friction_scale = 0.0;
  EXPECT_NE(FindRefusal(config).find("a margin needs friction"), std::string::npos);
  config.strategy.grip = "force";
  config.strategy.grip_force = 1.0;
  EXPECT_EQ(FindRefusal(config), "");
  config.conditions = {{"by margin", {"strategy.grip=margin"}}};
  EXPECT_NE(FindRefusal(config).find("a margin needs friction"), std::string::npos);
}

}  // namespace
}  // namespace graspbench
