#include "core/trial/measures/stability.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/pose.h"
#include "core/base/units.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;

// A ball that turns on the spot is no steadier than one that moves as fast as its surface.
TEST(SlipSpeed, CountsTurning) {
  WorldState state;
  EXPECT_EQ(CalcSlipSpeed(state, 0.05), 0.0);
  state.v_WOcm = Vector3d(0.3, 0.0, 0.4);
  EXPECT_DOUBLE_EQ(CalcSlipSpeed(state, 0.05), 0.5);
  state.v_WH = state.v_WOcm;
  state.w_WO = Vector3d(0.0, 2.0, 0.0);
  EXPECT_DOUBLE_EQ(CalcSlipSpeed(state, 0.05), 0.1);
}

// Two opposed soft fingers at +-a on the x axis; friction mu, torsion mu a, moments divided by a.
constexpr double kRadius = 0.05;
constexpr double kMu = 0.3;
constexpr double kWeight = 0.5;  // [N]

GraspInstant MakePinch() {
  GraspInstant instant;
  for (const double side : {-1.0, 1.0}) {
    instant.grasp.contacts.push_back(
        {Vector3d(side * kRadius, 0, 0), Vector3d(-side, 0, 0), kMu, kMu * kRadius, std::nullopt});
    instant.grasp.normal_forces.push_back(2.0);
    instant.grasp.digits.push_back(side > 0.0 ? 1 : 0);
  }
  instant.grasp.weight = Vector3d(0.0, -kWeight, 0.0);
  instant.grasp.radius = kRadius;
  instant.is_opposed = true;
  return instant;
}

/** Epsilon of the pinch by hand. Side s = +-1 has the wrenches (-s, t, x cross t) with t on an
octagon of radius mu, and (-s, 0, 0, +-mu, 0, 0). For a unit u let A = |u_2 + u_6, u_3 - u_5|, B the
same with the other signs; the octagon supports at least c A, c = cos 22.5 degrees, so

    h(u) = max(u_1 + mu max(c A, |u_4|), -u_1 + mu max(c B, |u_4|)),
    1 = u_1^2 + u_4^2 + (A^2 + B^2) / 2.

At a given h the right side is largest at A = u_4 = 0, u_1 = h, B = 2 h / (mu c): this is the
direction the pinch resists least, and 1 = h^2 + 2 h^2 / (mu c)^2. */
double CalcPinchEpsilon() {
  const double x = kMu * std::cos(kPi / 8.0);
  return x / std::sqrt(x * x + 2.0);
}

TEST(Stability, APinchByHand) {
  const StabilityPart part = CalcStabilityPart({MakePinch()});
  EXPECT_NEAR(part.quality, CalcPinchEpsilon(), 1e-9);
  EXPECT_EQ(part.normal_force, 4.0);
  EXPECT_EQ(part.slip_speed, 0.0);
  EXPECT_EQ(part.opposition, 1.0);
  EXPECT_EQ(part.num_samples, 1);
  EXPECT_NEAR(part.sigma_proposed, CalcPinchEpsilon() * 4.0 / kWeight, 1e-9);
}

// Down, friction has 2 mu F less the weight to give; that is the weakest way.
TEST(Stability, SigmaIsThePullThatTakesTheObjectOut) {
  const double expected = 2.0 * kMu * 2.0 - kWeight;
  EXPECT_NEAR(CalcStabilityPart({MakePinch()}).sigma, expected, 1e-9);
  // A palm turned about the contacts' line by a: |W + s| <= 2 mu F, s the pull at the angle a to the
  // weight.
  GraspInstant turned = MakePinch();
  const double angle = 0.5;
  turned.R_OPalm = MakeRotationRpy(angle, 0.0, 0.0);
  const double friction = 2.0 * kMu * 2.0, across = kWeight * std::sin(angle);
  EXPECT_NEAR(CalcStabilityPart({turned}).sigma,
              std::sqrt(friction * friction - across * across) - kWeight * std::cos(angle), 3e-4);
}

TEST(Stability, SlipAndMissingOppositionLowerIt) {
  const double steady = CalcStabilityPart({MakePinch()}).sigma_proposed;
  GraspInstant slipping = MakePinch(), unopposed = MakePinch();
  slipping.slip_speed = 0.02;
  unopposed.is_opposed = false;
  EXPECT_NEAR(CalcStabilityPart({slipping}).sigma_proposed, steady * std::exp(-2.0), 1e-12);
  const StabilityPart half = CalcStabilityPart({MakePinch(), unopposed});
  EXPECT_NEAR(half.sigma_proposed, 0.5 * steady, 1e-12);
  EXPECT_EQ(half.opposition, 0.5);
  GraspInstant strong = MakePinch();
  for (double& force : strong.grasp.normal_forces) force = 1e4;
  EXPECT_EQ(CalcStabilityPart({strong}).sigma_proposed, 10.0) << "at most ten loads";
}

TEST(Stability, FewerThanTwoContactsHoldNothing) {
  GraspInstant alone = MakePinch();
  alone.grasp.contacts.pop_back();
  alone.grasp.normal_forces.pop_back();
  alone.grasp.digits.pop_back();
  EXPECT_EQ(CalcStabilityPart({alone}).sigma, 0.0);
  EXPECT_EQ(CalcStabilityPart({alone}).sigma_proposed, 0.0);
  EXPECT_TRUE(std::isnan(CalcStabilityPart({}).sigma));
}

}  // namespace
}  // namespace graspbench
