#include <gtest/gtest.h>

#include "core/base/random.h"
#include "core/base/units.h"
#include "core/shape/primitives.h"
#include "human_study/events/hand_opening.h"
#include "human_study/events/hold.h"
#include "human_study/events/movement.h"
#include "tests/human_study/events/trajectories.h"
#include "tests/human_study/faults.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;

double MinimumJerkSpeed(double share) {
  return share > 0.0 && share < 1.0 ? 30.0 * share * share * (1 - share) * (1 - share) : 0.0;
}

// A reach of 0.4 m from 0.5 to 1.5 s.
ScalarCurve MakeBell(double shift = 0.0) {
  return SampleCurve(MakeTimes(shift, 2.5 + shift, 200),
                     [shift](double t) { return 0.4 * MinimumJerkSpeed(t - shift - 0.5); });
}

TEST(SurfaceDistance, MeetsClosedFormsInsideAndOutside) {
  const SurfaceDistance sphere = MakeSphereDistance(0.03);
  EXPECT_DOUBLE_EQ(sphere({0, 0, 0.05}), 0.02);
  EXPECT_DOUBLE_EQ(sphere({0.01, 0, 0}), -0.02);
  const SurfaceDistance cylinder = MakeCylinderDistance(0.03, 0.1);
  EXPECT_NEAR(cylinder({0, -0.05, 0.04}), 0.02, 1e-15);
  EXPECT_NEAR(cylinder({0, 0.01, 0.06}), 0.01, 1e-15);
  EXPECT_NEAR(cylinder({0.033, 0, 0.054}), 0.005, 1e-15);  // 3, 4, 5 beyond the edge
  EXPECT_NEAR(cylinder({0.0, 0.02, 0.049}), -0.001, 1e-15);
  const SurfaceDistance box = MakeBoxDistance({0.06, 0.04, 0.02});
  EXPECT_NEAR(box({0.05, 0, 0}), 0.02, 1e-15);
  EXPECT_NEAR(box({0.033, 0.024, 0.005}), 0.005, 1e-15);
  EXPECT_NEAR(box({0.0, 0.0, -0.004}), -0.006, 1e-15);
}

TEST(SurfaceDistance, OfAMeshAgreesWithThatOfTheSolid) {
  const Vector3d size(0.06, 0.04, 0.05);
  const SurfaceDistance solid = MakeBoxDistance(size);
  const SurfaceDistance field = MakeFieldDistance(
      std::make_shared<SignedDistanceField>(SignedDistanceField::Build(MakeRoundedBox(size, 0.0))));
  RandomStream random("surface", "points");
  for (int i = 0; i < 200; ++i) {
    Vector3d p_O;
    for (int axis = 0; axis < 3; ++axis) {
      p_O[axis] = (size[axis] / 2 + 0.012) * random.NextUniform(-1, 1);
    }
    EXPECT_NEAR(field(p_O), solid(p_O), 0.0006);
  }
}

TEST(TraceBack, InterpolatesARampExactly) {
  const ScalarCurve ramp = SampleCurve(MakeTimes(0, 1, 100), [](double t) { return 0.3 * t; });
  const EventTime event = TraceBack(ramp, 100, 0, 0.1234, Side::kAbove);
  EXPECT_NEAR(event.time, 0.1234 / 0.3, 1e-12);
  // A frame, and the spread of the instants for half and one and a half times the threshold.
  EXPECT_NEAR(event.uncertainty, std::hypot(0.01, 0.1234 / 0.3) / std::sqrt(12.0), 1e-9);
  EXPECT_FALSE(event.is_filled);
  EXPECT_FALSE(event.is_in_gap);
  EXPECT_FALSE(TraceBack(ramp, 5, 0, 0.1234, Side::kAbove).IsFound());
  EXPECT_FALSE(TraceBack(ramp, 100, 60, 0.1234, Side::kAbove).IsFound());
}

TEST(TraceBack, AGapGivesItsMiddleAndItsLengthAsUncertainty) {
  ScalarCurve step =
      SampleCurve(MakeTimes(0, 1, 100), [](double t) { return t < 0.5 ? 0.0 : 1.0; });
  for (size_t i = 46; i < 54; ++i) {
    step.states[i] = SampleState::kInvalid;
    step.At(i) = std::nan("");
  }
  const EventTime event = TraceBack(step, 100, 0, 0.5, Side::kAbove);
  EXPECT_TRUE(event.is_in_gap);
  EXPECT_NEAR(event.time, (0.45 + 0.54) / 2, 1e-12);
  EXPECT_NEAR(event.uncertainty, 0.09 / std::sqrt(12.0), 1e-12);
}

TEST(TraceBack, AFilledSampleWithinTheFiltersReachSetsTheFlag) {
  ScalarCurve ramp = SampleCurve(MakeTimes(0, 1, 100), [](double t) { return t; });
  ramp.reach = 0.03;
  ramp.states[47] = SampleState::kFilled;
  EXPECT_TRUE(TraceBack(ramp, 100, 0, 0.505, Side::kAbove).is_filled);
  EXPECT_FALSE(TraceBack(ramp, 100, 0, 0.525, Side::kAbove).is_filled);
}

TEST(TraceBack, ShortCrossingsAreNoiseWhenADurationIsAsked) {
  ScalarCurve fall =
      SampleCurve(MakeTimes(0, 1, 100), [](double t) { return t < 0.3 ? 1.0 : 0.0; });
  fall.values[60] = fall.values[61] = 1.0;
  EXPECT_NEAR(TraceBack(fall, 100, 0, 0.5, Side::kBelow).time, 0.615, 1e-9);
  EXPECT_NEAR(TraceBack(fall, 100, 0, 0.5, Side::kBelow, 0.04).time, 0.295, 1e-9);
}

TEST(Smooth, FindsTheNoiseThatWasAdded) {
  RandomStream random("noise", "test");
  const Trajectory path = SamplePath(MakeTimes(0, 10, 200), [&](double t) {
    const Vector3d noise(random.NextNormal(), random.NextNormal(), random.NextNormal());
    return Vector3d(Vector3d(0.1 * std::sin(t), 0.0, 0.0) + 0.0005 * noise);
  });
  const SmoothPath smooth = Smooth(path, 20.0);
  EXPECT_NEAR(smooth.noise, 0.0005, 0.00002);
  // What is left on the axis that does not move is the noise behind the filter.
  const double left =
      std::sqrt(smooth.path.p.row(2).squaredNorm() / static_cast<double>(path.size()));
  EXPECT_NEAR(smooth.smooth_noise, left, 0.1 * left);
}

TEST(CalcSpeed, IsExactForAStraightPathAndSilentBesideGaps) {
  Trajectory path =
      SamplePath(MakeTimes(0, 1, 100), [](double t) { return Vector3d(0.3 * t, 0, 0.4 * t); });
  HideSamples(path, 0.495, 0.525);
  const ScalarCurve speed = CalcSpeed(Smooth(path, 9.0));  // reach 20 ms
  EXPECT_NEAR(speed.values[0], 0.5, 1e-6);
  EXPECT_NEAR(speed.values[47], 0.5, 1e-6);
  EXPECT_TRUE(speed.IsValid(47));
  EXPECT_FALSE(speed.IsValid(48));
  EXPECT_FALSE(speed.IsValid(54));
  EXPECT_TRUE(speed.IsValid(55));
}

TEST(Movement, TheThresholdIsCrossedWhereTheBellCrossesIt) {
  const Movement movement = FindMovement(MakeBell(), 0.0, 2.5, MovementOptions());
  EXPECT_NEAR(0.4 * MinimumJerkSpeed(movement.onset.time - 0.5), 0.05, 2e-4);
  EXPECT_NEAR(movement.peak_speed, 0.75, 1e-9);  // 15 / 8 of the mean
  EXPECT_NEAR(movement.peak_time, 1.0, 1e-9);
  EXPECT_NEAR(movement.onset.time - 0.5, 1.5 - movement.end.time, 1e-9);
}

TEST(Movement, RegressionFindsTheTrueOnsetOfAMinimumJerkReach) {
  MovementOptions options;
  options.rule = "regression";
  const Movement movement = FindMovement(MakeBell(), 0.0, 2.5, options);
  EXPECT_NEAR(movement.onset.time, 0.5, 1e-6);
  EXPECT_NEAR(movement.end.time, 1.5, 1e-6);
}

TEST(Movement, RegressionFindsWhereAHandTurnsWithoutStopping) {
  MovementOptions options;
  options.rule = "regression";
  // The root of speed is a parabola about 0.5 s, lowest at a fifth of its peak at 1 s.
  const ScalarCurve curve = SampleCurve(MakeTimes(0.4, 1.5, 200), [](double t) {
    const double late = t < 1.0 ? t - 0.5 : 1.5 - t;
    return 0.4 * std::pow(0.2 + 3.2 * late * late, 2.0);
  });
  const Movement movement = FindMovement(curve, 0.4, 1.5, options);
  EXPECT_NEAR(movement.onset.time, 0.5, 1e-6);
  EXPECT_LT(movement.onset.uncertainty, 0.005);
}

TEST(Movement, EveryRuleFollowsAShiftAndSwapsItsEndsWhenTimeRunsBackwards) {
  for (const MovementRule& rule : MovementRuleList()) {
    MovementOptions options;
    options.rule = rule.id;
    const Movement movement = FindMovement(MakeBell(), 0.0, 2.5, options);
    ASSERT_TRUE(movement.onset.IsFound()) << rule.id << ": " << movement.onset.missing;
    EXPECT_NEAR(movement.onset.time, 0.55, 0.07) << rule.id;
    EXPECT_NEAR(movement.end.time, 1.45, 0.15) << rule.id;
    EXPECT_GT(movement.onset.uncertainty, 0.0) << rule.id;
    const Movement shifted = FindMovement(MakeBell(7.0), 7.0, 9.5, options);
    EXPECT_NEAR(shifted.onset.time, movement.onset.time + 7.0, 1e-9) << rule.id;
    const Movement reversed = FindMovement(Reverse(MakeBell()), -2.5, 0.0, options);
    EXPECT_NEAR(reversed.onset.time, -movement.end.time, 1e-9) << rule.id;
    EXPECT_NEAR(reversed.end.time, -movement.onset.time, 1e-9) << rule.id;
  }
}

TEST(Movement, LongestRunIgnoresATwitchBefore) {
  const ScalarCurve curve = SampleCurve(MakeTimes(0, 2.5, 200), [](double t) {
    return 0.4 * MinimumJerkSpeed(t - 0.5) + (t > 0.1 && t < 0.15 ? 0.1 : 0.0);
  });
  MovementOptions options;
  options.rule = "longest_run";
  EXPECT_NEAR(FindMovement(curve, 0.0, 2.5, options).onset.time,
              FindMovement(MakeBell(), 0.0, 2.5, options).onset.time, 1e-9);
}

TEST(Thin, KeepsEveryNthSampleAndNeverFewerThanAskedFor) {
  const auto make = [](double end) {
    return SampleCurve(MakeTimes(0.0, end, 100), [](double t) { return 2.0 * t; });
  };
  for (const double end : {1.0, 2.39, 2.4, 9.99}) {
    const ScalarCurve thin = Thin(make(end), 120);
    EXPECT_LT(thin.size(), 240u) << end;
    EXPECT_GE(thin.size(), std::min<size_t>(120, make(end).size())) << end;
    EXPECT_EQ(thin.values.size(), static_cast<Eigen::Index>(thin.size()));
    EXPECT_EQ(thin.states.size(), thin.size());
    for (size_t i = 0; i < thin.size(); ++i) {
      EXPECT_EQ(thin.At(i), 2.0 * thin.times[i]);
    }
  }
  EXPECT_DOUBLE_EQ(Thin(make(9.99), 120).times[1], 0.08);
}

ObjectTravel MakeLift(double speed) {
  ObjectTravel travel;
  travel.height = SampleCurve(
      MakeTimes(0, 3, 100), [speed](double t) { return std::clamp(speed * (t - 1.0), 0.0, 0.1); });
  travel.displacement = travel.unfiltered = travel.height;
  travel.unfiltered.noise = 1e-5;
  travel.lowest = travel.unfiltered;
  return travel;
}

TEST(LiftOff, ASteadyRiseIsTracedToItsStart) {
  const ObjectEvents events = FindObjectEvents(MakeLift(0.1), LiftOffOptions());
  EXPECT_NEAR(events.lift_off.time, 1.0, 1e-3);
  LiftOffOptions traced;
  traced.rule = "traced_back";
  EXPECT_NEAR(FindObjectEvents(MakeLift(0.1), traced).lift_off.time, 1.0,
              0.01);  // central differences spread the corner
  EXPECT_NEAR(events.moved.time, 1.02, 1e-9);
  LiftOffOptions rise;
  rise.rule = "rise";
  EXPECT_NEAR(FindObjectEvents(MakeLift(0.1), rise).lift_off.time, 1.03, 1e-9);
}

TEST(LiftOff, AnObjectThatStaysIsNotLifted) {
  ObjectTravel travel = MakeLift(0.1);
  travel.height.values *= 0.05;
  EXPECT_EQ(FindObjectEvents(travel, LiftOffOptions()).lift_off.missing,
            "the object does not rise far enough");
}

// Two bumps: 100 mm at 0.4 s, `second` at 0.8 s.
ScalarCurve MakeBumps(double second) {
  return SampleCurve(MakeTimes(0, 1.2, 200), [second](double t) {
    const auto bump = [t](double at, double top) {
      return std::max(0.0, top - 2.0 * (t - at) * (t - at));
    };
    return std::max(bump(0.4, 0.1), bump(0.8, second));
  });
}

TEST(PeakOpening, TheTopOfAParabolaIsExactBetweenSamples) {
  const ScalarCurve curve = SampleCurve(
      MakeTimes(0, 1, 100), [](double t) { return 0.1 - 0.5 * (t - 0.4137) * (t - 0.4137); });
  const PeakOpening peak = FindPeakOpening(curve, 0.0, std::nan(""), 1.0, 0.003);
  EXPECT_NEAR(peak.largest.time, 0.4137, 1e-9);
  EXPECT_NEAR(peak.largest_value, 0.1, 1e-12);
  EXPECT_FALSE(peak.is_ambiguous);
  EXPECT_NEAR(peak.last.time, 0.4137, 1e-9);
}

TEST(PeakOpening, TheLastMaximumIsToldFromTheLargest) {
  const PeakOpening peak = FindPeakOpening(MakeBumps(0.09), 0.0, 1.0, 1.2, 0.003);
  EXPECT_NEAR(peak.largest.time, 0.4, 1e-9);
  EXPECT_NEAR(peak.last.time, 0.8, 1e-9);
  EXPECT_NEAR(peak.last_value, 0.09, 1e-9);
  EXPECT_TRUE(peak.is_ambiguous);
  // Before the first contact there is only one.
  EXPECT_FALSE(FindPeakOpening(MakeBumps(0.09), 0.0, 0.5, 1.2, 0.003).is_ambiguous);
  // Between the bumps the hand nearly closes: a bump of 50 mm rises by less than that.
  EXPECT_TRUE(FindPeakOpening(MakeBumps(0.05), 0.0, 1.0, 1.2, 0.003).is_ambiguous);
  EXPECT_FALSE(FindPeakOpening(MakeBumps(0.05), 0.0, 1.0, 1.2, 0.05).is_ambiguous);
}

// Half of the vectors are shorter: P(r < x) = erf(x / sqrt 2) - sqrt(2 / pi) x exp(-x^2 / 2).
TEST(MedianPerSd, HalfOfNormalVectorsAreShorter) {
  const double x = kMedianPerSd;
  const double share =
      std::erf(x / std::sqrt(2.0)) - std::sqrt(2.0 / kPi) * x * std::exp(-0.5 * x * x);
  EXPECT_NEAR(share, 0.5, 2e-5);
}

}  // namespace
}  // namespace graspbench
