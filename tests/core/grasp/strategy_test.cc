#include "core/grasp/strategy.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace graspbench {
namespace {

constexpr double kStep = 0.001;

struct Entry {
  Phase phase;
  double duration;
};

/** Runs the machine; the digits touch at `touch_time` after the start, the grip is steady. */
std::vector<Entry> RunPhases(const StrategyConfig& config, double touch_time) {
  GraspStrategy strategy(config, 0.1);
  strategy.StartPlacing(config.placing_time);
  std::vector<Entry> phases = {{strategy.phase(), 0.0}};
  for (double time = 0.0; strategy.phase() != Phase::kDone && time < 60.0; time += kStep) {
    StrategyObservation observation;
    observation.all_digits_touched = time >= touch_time;
    observation.grip_force = observation.all_digits_touched ? 3.0 : 0.0;
    strategy.Step(kStep, observation);
    if (strategy.phase() != phases.back().phase) phases.push_back({strategy.phase(), 0.0});
    phases.back().duration += kStep;
  }
  return phases;
}

TEST(GraspStrategy, GoesThroughThePhasesInOrderForTheirTimes) {
  const StrategyConfig config;
  const double touch_time = config.placing_time + 0.4;
  const std::vector<Entry> phases = RunPhases(config, touch_time);
  const std::vector<Phase> order = {Phase::kPlacing, Phase::kClosure, Phase::kStabilisation,
                                    Phase::kLiftOff, Phase::kHold,    Phase::kDone};
  ASSERT_EQ(phases.size(), order.size());
  for (size_t i = 0; i < order.size(); ++i) EXPECT_EQ(phases[i].phase, order[i]);
  EXPECT_NEAR(phases[0].duration, config.placing_time, 2 * kStep);
  EXPECT_NEAR(phases[1].duration, 0.4, 3 * kStep);
  // Stabilisation lasts until the command has reached the target and the grip is steady.
  EXPECT_NEAR(phases[2].duration, config.closure_time - 0.4 + 0.1, 3 * kStep);
  EXPECT_NEAR(phases[3].duration, config.lift_time, 2 * kStep);
  EXPECT_NEAR(phases[4].duration, config.hold_time, 2 * kStep);
}

TEST(GraspStrategy, WaitsForMissingDigitsOnlySoLong) {
  const StrategyConfig config;
  const std::vector<Entry> phases = RunPhases(config, 1e9);
  ASSERT_GT(phases.size(), 2u);
  EXPECT_NEAR(phases[1].duration, config.closure_time + config.closure_patience, 2 * kStep);
}

// A guarded close may take longer than the longest stabilisation: that begins when it has ended.
TEST(GraspStrategy, NeverLiftsWhileDigitsOfARegulatedGripStillClose) {
  const StrategyConfig config;
  for (const double closing_time : {0.0, 3.0}) {
    GraspStrategy strategy(config, 0.1);
    strategy.StartPlacing(config.placing_time);
    double stabilisation = 0.0;
    while (strategy.phase() < Phase::kLiftOff) {
      StrategyObservation observation;
      observation.all_digits_touched = observation.is_regulated = true;
      observation.is_closing = stabilisation < closing_time;
      strategy.Step(kStep, observation);
      if (strategy.phase() == Phase::kStabilisation) stabilisation += kStep;
      ASSERT_LT(stabilisation, 60.0);
    }
    EXPECT_NEAR(stabilisation, closing_time + config.stabilisation_max_time, 3 * kStep);
  }
}

TEST(GraspStrategy, NeverClosesBeforeTheHandHasArrived) {
  const StrategyConfig config;
  GraspStrategy strategy(config, 0.1);
  strategy.StartPlacing(config.placing_time);
  while (strategy.phase() == Phase::kPlacing) {
    EXPECT_EQ(strategy.Step(kStep, {}).closing, 0.0);
  }
  EXPECT_NEAR(strategy.Step(kStep, {}).distance, 0.0, 1e-12);
}

// The speed is the derivative of the distance, in placing and in lift-off.
TEST(GraspStrategy, SpeedIsTheDerivativeOfTheDistance) {
  GraspStrategy strategy(StrategyConfig(), 0.1);
  strategy.StartPlacing(StrategyConfig().placing_time);
  StrategyObservation touching;
  touching.all_digits_touched = true;
  touching.grip_force = 1.0;
  StrategyCommand before = strategy.Step(kStep, touching);
  double travelled = 0.0;
  while (strategy.phase() != Phase::kDone) {
    const StrategyCommand now = strategy.Step(kStep, touching);
    EXPECT_NEAR(now.distance - before.distance, 0.5 * kStep * (now.speed + before.speed), 1e-7);
    travelled += std::abs(now.distance - before.distance);
    before = now;
  }
  EXPECT_NEAR(travelled, 0.2, 1e-3);  // down by d and up by d
}

TEST(GraspStrategy, StartingLateGivesTheSameCourse) {
  GraspStrategy whole(StrategyConfig(), 0.1), late(StrategyConfig(), 0.1);
  whole.StartPlacing(StrategyConfig().placing_time);
  late.StartPlacing(0.3);
  StrategyCommand a, b;
  for (int i = 0; i < 600; ++i) a = whole.Step(kStep, {});
  for (int i = 0; i < 100; ++i) b = late.Step(kStep, {});
  EXPECT_NEAR(a.distance, b.distance, 1e-9);
  EXPECT_NEAR(late.CalcPlacingDistance(0.2), a.distance, 1e-9);
}

}  // namespace
}  // namespace graspbench
