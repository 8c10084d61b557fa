#include "human_study/events/lift_off_fit.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/random.h"
#include "tests/human_study/events/trajectories.h"

namespace graspbench {
namespace {

struct LiftErrors {
  double bias = 0.0, covered = 0.0;
};

/** 100 lifts that start at a known instant, seen at `rate` with noise. */
template <class Rise>
LiftErrors MeasureLiftErrors(double rate, double noise, const Rise& rise) {
  constexpr int kNumLifts = 100;
  RandomStream random("lift-off", "noise");
  LiftErrors errors;
  for (int k = 0; k < kNumLifts; ++k) {
    const double lift_off = 1.0 + random.NextUniform(0.0, 1.0 / rate);
    ScalarCurve height = SampleCurve(MakeTimes(0.0, 2.2, rate), [&](double t) {
      return (t > lift_off ? rise(t - lift_off) : 0.0) + noise * random.NextNormal();
    });
    height.noise = noise;
    const EventTime found = FitLiftOff(height, lift_off + random.NextUniform(-0.03, 0.05));
    const double error = found.time - lift_off;
    errors.bias += error / kNumLifts;
    errors.covered += (std::abs(error) < found.CalcHalfWidth() ? 1.0 : 0.0) / kNumLifts;
  }
  return errors;
}

// 100 mm in 0.8 s along a minimum-jerk path; with an acceleration of 1 m/s^2; with a speed at once.
double RiseGently(double s) { return 0.1 * Ease(s, 0.0, 0.8); }
double RiseEvenly(double s) { return 0.5 * s * s; }
double RiseAtOnce(double s) { return 0.06 * s + 0.5 * s * s; }

// How a lift starts is not known: over starts, rates and noise there is no bias, and each is
// covered.
TEST(LiftOffFit, IsWithoutBiasOverAllStartsAndCovers) {
  double bias = 0.0, covered = 0.0, count = 0.0;
  for (const double rate : {60.0, 200.0, 500.0}) {
    for (const double noise : {0.05e-3, 0.3e-3}) {
      for (double (*rise)(double) : {RiseGently, RiseEvenly, RiseAtOnce}) {
        const LiftErrors errors = MeasureLiftErrors(rate, noise, rise);
        bias += errors.bias;
        covered += errors.covered;
        count += 1.0;
        EXPECT_GE(errors.covered, 0.85) << rate << " " << noise;
      }
    }
  }
  EXPECT_LT(std::abs(bias / count), 3e-3);
  EXPECT_GE(covered / count, 0.90);
}

TEST(LiftOffFit, SaysWhereNothingIsMeasured) {
  ScalarCurve height =
      SampleCurve(MakeTimes(0.0, 2.0, 100.0), [](double t) { return 0.1 * Ease(t, 1.0, 1.8); });
  height.noise = 1e-4;
  for (size_t i = 0; i < height.size(); ++i) height.states[i] = SampleState::kFilled;
  EXPECT_EQ(FitLiftOff(height, 1.0).missing,
            "too few measured samples before or after the lift-off");
}

}  // namespace
}  // namespace graspbench
