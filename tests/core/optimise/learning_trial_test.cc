#include "core/optimise/learning_trial.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/error.h"

namespace graspbench {
namespace {

constexpr double kNever = std::numeric_limits<double>::quiet_NaN();

TrialResult MakeResult(double thumb_time, double sigma) {
  TrialResult result;
  result.outcome = Outcome::kSuccess;
  result.contacts = {{"TH", true, thumb_time}, {"FF", false, 0.4}};
  result.timing = CalcContactTiming(result.contacts, 0.0);
  result.touches.resize(2);
  result.touches[0].closing = thumb_time;
  result.touches[0].smallest_gap = std::isnan(thumb_time) ? 0.012 : 0.0;
  result.touches[1].closing = 0.4;
  result.touches[1].smallest_gap = 0.0;
  result.stability.sigma = sigma;
  result.stability.stabilisation.quality = 0.25;
  return result;
}

TEST(Fitness, IsSigmaOrTheMissingThumbsDistance) {
  EXPECT_EQ(CalcFitness(MakeLearningTrial(0, MakeResult(0.5, 3.5), false)), 3.5);
  EXPECT_EQ(CalcFitness(MakeLearningTrial(0, MakeResult(kNever, 0.0), false)), -0.012);
  EXPECT_EQ(CalcFitness(MakeLearningTrial(0, MakeResult(0.5, kNever), false)), 0.0);
  EXPECT_LT(CalcFitness(MakeLearningTrial(0, TrialResult(), false)),
            -0.5);  // nothing was simulated
  EXPECT_DOUBLE_EQ(
      CalcFitness(std::vector<LearningTrial>{MakeLearningTrial(1, MakeResult(0.5, 3.0), false),
                                             MakeLearningTrial(2, MakeResult(0.5, 1.0), false)}),
      2.0);
}

// Twice the grip that it may use: half as much counts. Less than it may use: as it is.
TEST(Fitness, CountsSigmaAsFarAsTheHandMayGrip) {
  TrialResult result = MakeResult(0.5, 3.0);
  result.stability.hold.normal_force = 20.0;
  const LearningTrial trial = MakeLearningTrial(0, result, false);
  EXPECT_DOUBLE_EQ(CalcFitness(trial, 10.0), 1.5);
  EXPECT_DOUBLE_EQ(CalcFitness(trial, 20.0), 3.0);
  EXPECT_DOUBLE_EQ(CalcFitness(trial, 40.0), 3.0);
  EXPECT_DOUBLE_EQ(CalcFitness(trial), 3.0);
  // A thumb in the air grips nothing.
  EXPECT_EQ(CalcFitness(MakeLearningTrial(0, MakeResult(kNever, 0.0), false), 10.0), -0.012);
}

LearningTrial MakeStrong(double strength, double grip, double thumb_time = 0.5) {
  TrialResult result = MakeResult(thumb_time, 100.0);  // sigma does not count
  result.strength = strength;
  result.stability.hold.normal_force = grip;
  return MakeLearningTrial(0, result, false);
}

// What holds is better than what is lost, which is better the later it was lost, and with its
// thumb nearer.
TEST(Fitness, OfStrengthIsWhatThePullsFoundAndLeadsLostObjectsBack) {
  EXPECT_DOUBLE_EQ(CalcFitness(MakeStrong(3.0, 20.0), 10.0), 1.5);
  EXPECT_DOUBLE_EQ(CalcFitness(MakeStrong(3.0, 20.0)), 3.0);
  EXPECT_DOUBLE_EQ(CalcFitness(MakeStrong(-0.2, 20.0), 10.0), -0.2);
  EXPECT_DOUBLE_EQ(CalcFitness(MakeStrong(-0.2, kNever, kNever)), -0.212);
  EXPECT_DOUBLE_EQ(CalcMeanStrength({MakeStrong(3.0, 1.0), MakeStrong(-0.2, 1.0)}), 1.5);
  EXPECT_TRUE(std::isnan(CalcMeanStrength({MakeLearningTrial(0, MakeResult(0.5, 3.0), false)})));
}

TEST(LearningTrial, KeepsItsStrength) {
  const LearningTrial trial = MakeStrong(1.0 / 3.0, 2.0);
  EXPECT_EQ(LearningTrialFromJson(ToJson(trial)).strength, trial.strength);
  EXPECT_FALSE(ToJson(MakeLearningTrial(0, MakeResult(0.5, 3.0), false)).contains("strength_n"));
}

TEST(LearningTrial, IsReadAsItWasWritten) {
  for (const double time : {0.1 + 0.2, kNever}) {
    TrialResult result = MakeResult(time, 1.0 / 3.0);
    if (!std::isnan(time)) result.touches[0].q = Eigen::Vector2d(0.1, -1.0 / 3.0);
    EXPECT_TRUE(MakeLearningTrial(7, result, false).touch_postures.empty());
    const LearningTrial trial = MakeLearningTrial(7, result, true);
    const LearningTrial read = LearningTrialFromJson(Json::parse(FormatJson(ToJson(trial))));
    EXPECT_EQ(FormatJson(ToJson(read)), FormatJson(ToJson(trial)));
    EXPECT_EQ(read.sigma, trial.sigma);
    EXPECT_EQ(read.draw, 7);
    ASSERT_EQ(read.touch_postures.size(), 2u);
    EXPECT_EQ(read.touch_postures[0], result.touches[0].q);
    EXPECT_EQ(read.touch_postures[1].size(), 0);
    EXPECT_EQ(CalcFitness(read), CalcFitness(trial));
    EXPECT_EQ(std::isnan(read.timing.gft), std::isnan(time));
  }
}

// Else a pre-grasp whose simulation gave up would be the one with the most simultaneous contacts.
TEST(LearningTrial, OneThatGaveUpHasNoTiming) {
  TrialResult result;
  result.outcome = Outcome::kNumericalFailure;
  const LearningTrial trial = MakeLearningTrial(0, result, false);
  const LearningTrial read = LearningTrialFromJson(Json::parse(FormatJson(ToJson(trial))));
  for (const LearningTrial* one : {&trial, &read}) {
    EXPECT_TRUE(std::isnan(one->timing.gct));
    EXPECT_TRUE(std::isnan(one->timing.gft_ratio));
  }
}

TEST(LearningTrial, TwoThumbsAreRefused) {
  Json json = ToJson(MakeLearningTrial(0, MakeResult(0.5, 1.0), false));
  json["digits"][1]["is_thumb"] = true;
  EXPECT_THROW(LearningTrialFromJson(json), Error);
}

}  // namespace
}  // namespace graspbench
