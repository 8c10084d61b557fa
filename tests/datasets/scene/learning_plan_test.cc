#include "datasets/scene/learning_plan.h"

#include <gtest/gtest.h>

#include "core/base/config.h"

namespace graspbench {
namespace {

// A frozen configuration is complete; those of before there were spaces searched the thumb.
TEST(CompleteOptimiseConfig, AddsWhatOlderConfigurationsLack) {
  Json frozen = ConfigToJson(SceneConfig());
  const Json whole = frozen;
  frozen["optimise"].erase("search");
  ASSERT_NE(frozen, whole);
  CompleteOptimiseConfig(frozen);
  EXPECT_EQ(frozen["optimise"]["search"], "thumb");
  Diagnostics problems;
  const auto config = ConfigFromJson<SceneConfig>(frozen, "scene.json", problems);
  problems.ThrowIfErrors(ErrorKind::kFormat, "incomplete");
  EXPECT_EQ(ConfigToJson(config), whole);

  frozen["optimise"]["search"] = "synergy";
  CompleteOptimiseConfig(frozen);
  EXPECT_EQ(frozen["optimise"]["search"], "synergy");

  Json damaged = Json::array();
  CompleteOptimiseConfig(damaged);
  EXPECT_EQ(damaged, Json::array());
}

TEST(ValidateOptimiseConfig, NamesTheKnownSpaces) {
  OptimiseConfig config;
  EXPECT_TRUE(Validate(config).empty());
  config.search = "hand";
  const std::vector<ConfigProblem> problems = Validate(config);
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_EQ(problems[0].key, "search");
  EXPECT_NE(problems[0].text.find("thumb, hand-pose, all-digits, synergy, closing"),
            std::string::npos)
      << problems[0].text;
}

}  // namespace
}  // namespace graspbench
