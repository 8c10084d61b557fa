#include "datasets/scene/learning_plan.h"

#include <gtest/gtest.h>

#include "core/base/config.h"

namespace graspbench {
namespace {

// A frozen configuration is complete; those of before there were spaces and fitnesses searched the
// thumb for sigma.
TEST(CompleteOptimiseConfig, AddsWhatOlderConfigurationsLack) {
  Json frozen = ConfigToJson(SceneConfig());
  const Json whole = frozen;
  frozen["optimise"].erase("search");
  frozen["optimise"].erase("fitness");
  frozen["optimise"].erase("race");
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

// Journals of before there was strength are answers to the same questions as today's sigma.
TEST(LearningPlan, AskingForStrengthIsAnotherQuestion) {
  const auto object = std::make_shared<GraspObject>();
  const SceneInputs inputs = {std::make_shared<Hand>(), object, {}};
  LearningRequest request;
  const SceneConfig config;
  EXPECT_FALSE(MakeLearningSetup(config, inputs, request, 0).finds_strength);
  const std::string sigma = CalcLearningTrialId(config, inputs, request, 0);
  request.finds_strength = true;
  EXPECT_TRUE(MakeLearningSetup(config, inputs, request, 0).finds_strength);
  EXPECT_NE(CalcLearningTrialId(config, inputs, request, 0), sigma);
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
