#include "core/sim/stability.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/units.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;

// Two opposed soft fingers at +-a on the x axis; friction mu, torsion mu a, moments divided by a.
constexpr double kRadius = 0.05;
constexpr double kMu = 0.3;

GraspInstant MakePinch() {
  GraspInstant instant;
  for (const double side : {-1.0, 1.0}) {
    instant.contacts.push_back(
        {Vector3d(side * kRadius, 0, 0), Vector3d(-side, 0, 0), kMu, kMu * kRadius, std::nullopt});
  }
  instant.normal_force = 4.0;
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

constexpr double kWeight = 2.0;

TEST(Stability, APinchByHand) {
  const StabilityPart part = CalcStabilityPart({MakePinch()}, kWeight, kRadius);
  EXPECT_NEAR(part.quality, CalcPinchEpsilon(), 1e-9);
  EXPECT_EQ(part.normal_force, 4.0);
  EXPECT_EQ(part.slip_speed, 0.0);
  EXPECT_EQ(part.opposition, 1.0);
  EXPECT_EQ(part.num_samples, 1);
  EXPECT_NEAR(part.sigma, CalcPinchEpsilon() * 4.0 / kWeight, 1e-9);
}

TEST(Stability, SlipAndMissingOppositionLowerIt) {
  const double steady = CalcStabilityPart({MakePinch()}, kWeight, kRadius).sigma;
  GraspInstant slipping = MakePinch(), unopposed = MakePinch();
  slipping.slip_speed = 0.02;
  unopposed.is_opposed = false;
  EXPECT_NEAR(CalcStabilityPart({slipping}, kWeight, kRadius).sigma, steady * std::exp(-2.0),
              1e-12);
  const StabilityPart half = CalcStabilityPart({MakePinch(), unopposed}, kWeight, kRadius);
  EXPECT_NEAR(half.sigma, 0.5 * steady, 1e-12);
  EXPECT_EQ(half.opposition, 0.5);
}

TEST(Stability, TenLoadsAreTheMost) {
  GraspInstant strong = MakePinch();
  strong.normal_force = 1e4;
  EXPECT_EQ(CalcStabilityPart({strong}, kWeight, kRadius).sigma, 10.0);
}

TEST(Stability, FewerThanTwoContactsHoldNothing) {
  GraspInstant alone = MakePinch();
  alone.contacts.pop_back();
  EXPECT_EQ(CalcStabilityPart({alone}, kWeight, kRadius).sigma, 0.0);
  EXPECT_TRUE(std::isnan(CalcStabilityPart({}, kWeight, kRadius).sigma));
}

}  // namespace
}  // namespace graspbench
