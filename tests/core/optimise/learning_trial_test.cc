#include "core/optimise/learning_trial.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/error.h"
#include "core/trial/judge/judge.h"
#include "tests/core/trial/test_pinch.h"

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

TEST(LearningTrial, TwoThumbsAreRefused) {
  Json json = ToJson(MakeLearningTrial(0, MakeResult(0.5, 1.0), false));
  json["digits"][1]["is_thumb"] = true;
  EXPECT_THROW(LearningTrialFromJson(json), Error);
}

constexpr double kMass = 0.05, kMu = 0.4;

LearningTrial MakeTrial(double strength, double grip) {
  LearningTrial trial;
  trial.strength = strength;
  trial.stability.normal_force = grip;
  return trial;
}

// Two pads on a block bear mu F each, of which the weight has its part: by pulling in physics the
// whole of the bound, straight down.
TEST(Headroom, APinchUsesAllThatFrictionAllows) {
  for (const double force : {1.5, 3.0, 6.0}) {
    const TestPinch pinch(force, kMass, kMu, {0.0, 0.0, -kStandardGravity});
    const double strength = FindWeakestForce(pinch.MakeHeldObject());
    EXPECT_NEAR(strength, 2.0 * kMu * force - kMass * kStandardGravity, 0.03 * 2.0 * kMu * force);
    const Headroom headroom =
        CalcHeadroom({MakeTrial(strength, 2.0 * force)}, *pinch.setup().object, kStandardGravity);
    EXPECT_NEAR(headroom.bound, 2.0 * kMu * force - kMass * kStandardGravity, 1e-9);
    EXPECT_NEAR(headroom.share, 1.0, 0.05);
  }
}

TEST(Headroom, GripThatDoesNotBearTheWeightAllowsNothing) {
  EXPECT_EQ(CalcFrictionBound(2.0, 0.5, 3.0), 0.0);
  EXPECT_DOUBLE_EQ(CalcFrictionBound(2.0, 0.5, 0.25), 0.75);
}

GraspObject MakeHeadroomCube() {
  GraspObject cube = *TestPinch(3.0, kMass, kMu, Eigen::Vector3d::Zero()).setup().object;
  cube.surface.friction_dynamic = 0.5 * kMu;  // what is held does not slide
  return cube;
}

// Bounds of 1.5 and 3.5 N, of which 1 and 2 are borne; what was lost has no grip to speak of.
TEST(Headroom, IsThatOfTheTrialsThatHeld) {
  const Headroom headroom =
      CalcHeadroom({MakeTrial(1.0, 5.0), MakeTrial(2.0, 10.0), MakeTrial(-0.3, 0.0)},
                   MakeHeadroomCube(), 0.5 / kMass);
  EXPECT_NEAR(headroom.bound, 2.5, 1e-12);
  EXPECT_NEAR(headroom.share, 0.6, 1e-12);
  EXPECT_TRUE(std::isnan(CalcHeadroom({MakeTrial(-0.3, 0.0)}, MakeHeadroomCube(), 9.8).share));
}

TEST(Headroom, AGraspAboveItsBoundLeavesNothingToGain) {
  EXPECT_EQ(CalcMostGain(0.8), 1.25);
  EXPECT_EQ(CalcMostGain(1.4), 1.0);
}

}  // namespace
}  // namespace graspbench
