#include "datasets/scene/scene_store.h"

#include <gtest/gtest.h>

#include "tests/datasets/find_error.h"

namespace graspbench {
namespace {

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
  EXPECT_TRUE(Has(problems[0].text, "thumb, hand-pose, all-digits, synergy, closing"));
}

}  // namespace
}  // namespace graspbench
