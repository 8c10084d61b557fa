#include "core/optimise/headroom.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/trial/judge/judge.h"
#include "tests/core/trial/test_pinch.h"

namespace graspbench {
namespace {

constexpr double kMass = 0.05, kMu = 0.4;

LearningTrial MakeTrial(double strength, double grip) {
  LearningTrial trial;
  trial.strength = strength;
  trial.stability.normal_force = grip;
  return trial;
}

GraspObject MakeCube() {
  GraspObject cube = *TestPinch(3.0, kMass, kMu, Eigen::Vector3d::Zero()).setup().object;
  cube.surface.friction_dynamic = 0.5 * kMu;  // what is held does not slide
  return cube;
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

// Bounds of 1.5 and 3.5 N, of which 1 and 2 are borne; what was lost has no grip to speak of.
TEST(Headroom, IsThatOfTheTrialsThatHeld) {
  const Headroom headroom = CalcHeadroom(
      {MakeTrial(1.0, 5.0), MakeTrial(2.0, 10.0), MakeTrial(-0.3, 0.0)}, MakeCube(), 0.5 / kMass);
  EXPECT_NEAR(headroom.bound, 2.5, 1e-12);
  EXPECT_NEAR(headroom.share, 0.6, 1e-12);
  EXPECT_TRUE(std::isnan(CalcHeadroom({MakeTrial(-0.3, 0.0)}, MakeCube(), 9.8).share));
}

TEST(Headroom, AGraspAboveItsBoundLeavesNothingToGain) {
  EXPECT_EQ(CalcMostGain(0.8), 1.25);
  EXPECT_EQ(CalcMostGain(1.4), 1.0);
}

}  // namespace
}  // namespace graspbench
