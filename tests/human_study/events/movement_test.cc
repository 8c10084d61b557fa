#include "human_study/events/movement.h"

#include <gtest/gtest.h>

#include "core/base/random.h"
#include "tests/human_study/events/trajectories.h"

namespace graspbench {
namespace {

/** A minimum-jerk movement along a line: speed and acceleration in closed form. */
struct Bell {
  double begin, duration, way;
  double Share(double t) const { return std::clamp((t - begin) / duration, 0.0, 1.0); }
  double Speed(double t) const {
    const double s = Share(t);
    return 30.0 * way / duration * s * s * (1 - s) * (1 - s);
  }
  double Acceleration(double t) const {
    const double s = Share(t);
    return 60.0 * way / (duration * duration) * s * (1 - s) * (1 - 2 * s);
  }
  double Jerk(double t) const {
    const double s = Share(t);
    const bool moves = s > 0.0 && s < 1.0;
    return moves ? 60.0 * way / (duration * duration * duration) * (1 - 6 * s + 6 * s * s) : 0.0;
  }
  double Position(double t) const {
    const double s = Share(t);
    return way * s * s * s * (10 - 15 * s + 6 * s * s);
  }
};

struct TwoPhases {
  Bell first, second;
  template <class Part>
  double Sum(const Part& part, double t) const {
    return (first.*part)(t) + (second.*part)(t);
  }
};

/** The root of a function that changes its sign once between two instants. */
double FindRoot(const std::function<double(double)>& f, double low, double high) {
  for (int i = 0; i < 80; ++i) {
    const double middle = 0.5 * (low + high);
    ((f(middle) > 0.0) == (f(low) > 0.0) ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

MovementPhases FindIn(const ScalarCurve& speed) {
  return FindPhases(speed, FindMovement(speed, speed.times.front(), speed.times.back(), {}));
}

// A hand that stops between two movements has ended the first: by its threshold, not by a phase.
TEST(FindPhases, AStopEndsTheMovement) {
  const TwoPhases reach = {{0.3, 0.6, 0.35}, {0.9, 0.4, 0.05}};
  const MovementPhases phases = FindIn(
      SampleCurve(MakeTimes(0, 1.8, 200), [&](double t) { return reach.Sum(&Bell::Speed, t); }));
  EXPECT_FALSE(phases.reacceleration.IsFound());
}

// One begins while the other still slows down: the lowest speed lies where a1 + a2 = 0.
TEST(FindPhases, OverlappingMovementsHaveTheirLowestSpeedWhereTheAccelerationsCancel) {
  for (const double begin : {0.75, 0.78, 0.82}) {
    const TwoPhases reach = {{0.3, 0.6, 0.35}, {begin, 0.4, 0.07}};
    const auto a = [&](double t) { return reach.Sum(&Bell::Acceleration, t); };
    const double truth = FindRoot(a, begin, 0.9);
    ASSERT_NEAR(a(truth), 0.0, 1e-6);
    const MovementPhases phases = FindIn(
        SampleCurve(MakeTimes(0, 1.8, 200), [&](double t) { return reach.Sum(&Bell::Speed, t); }));
    ASSERT_TRUE(phases.reacceleration.IsFound()) << begin;
    EXPECT_TRUE(phases.rises);
    EXPECT_NEAR(phases.reacceleration.time, truth, 0.001) << begin;
  }
}

// A second movement too weak to raise the speed: the hand decelerates least where the jerk is 0.
TEST(FindPhases, WithoutARiseItIsTheLeastDeceleration) {
  const TwoPhases reach = {{0.3, 0.7, 0.35}, {0.8, 0.25, 0.02}};
  const auto jerk = [&](double t) { return reach.Sum(&Bell::Jerk, t); };
  const auto a = [&](double t) { return reach.Sum(&Bell::Acceleration, t); };
  const double truth = FindRoot(jerk, 0.82, 0.89);
  ASSERT_LT(a(truth), 0.0) << "it would rise";
  ASSERT_LT(a(truth + 0.03), a(truth) - 0.02);
  const MovementPhases phases = FindIn(
      SampleCurve(MakeTimes(0, 1.8, 200), [&](double t) { return reach.Sum(&Bell::Speed, t); }));
  ASSERT_TRUE(phases.reacceleration.IsFound()) << phases.reacceleration.missing;
  EXPECT_FALSE(phases.rises);
  EXPECT_NEAR(phases.reacceleration.time, truth, 0.003);
}

TEST(FindPhases, OneMovementHasNone) {
  for (const double duration : {0.5, 0.8, 1.2}) {
    const Bell bell = {0.3, duration, 0.35};
    const MovementPhases phases =
        FindIn(SampleCurve(MakeTimes(0, 2.0, 200), [&](double t) { return bell.Speed(t); }));
    EXPECT_FALSE(phases.reacceleration.IsFound()) << duration;
    EXPECT_EQ(phases.reacceleration.missing, "the hand slows down once, without a second phase");
  }
}

// Through the filter and with the noise of a laboratory: 0.3 mm at 200 Hz.
TEST(FindPhases, NoiseNeitherMakesASecondPhaseNorHidesOne) {
  const TwoPhases reach = {{0.3, 0.6, 0.35}, {0.82, 0.4, 0.07}};
  const double truth =
      FindRoot([&](double t) { return reach.Sum(&Bell::Acceleration, t); }, 0.82, 0.92);
  RandomStream random("phases", "noise");
  int num_found = 0, num_made_up = 0;
  double square_sum = 0.0;
  for (int trial = 0; trial < 40; ++trial) {
    for (const bool has_two : {true, false}) {
      const Trajectory path = SamplePath(MakeTimes(0, 1.8, 200), [&](double t) {
        const Eigen::Vector3d noise(random.NextNormal(), random.NextNormal(), random.NextNormal());
        const double x = has_two ? reach.Sum(&Bell::Position, t) : reach.first.Position(t);
        return Eigen::Vector3d(Eigen::Vector3d(x, 0.0, 0.0) + 0.0003 * noise);
      });
      const MovementPhases phases = FindIn(CalcSpeed(Smooth(path, 10.0)));
      if (!phases.reacceleration.IsFound()) continue;
      (has_two ? num_found : num_made_up) += 1;
      if (has_two) square_sum += std::pow(phases.reacceleration.time - truth, 2);
    }
  }
  EXPECT_EQ(num_found, 40);
  EXPECT_LE(num_made_up, 2);
  EXPECT_LT(std::sqrt(square_sum / 40), 0.008);
}

TEST(FindPhases, AHiddenWristIsSaid) {
  const Bell bell = {0.3, 0.8, 0.35};
  ScalarCurve speed = SampleCurve(MakeTimes(0, 2.0, 200), [&](double t) { return bell.Speed(t); });
  const Movement movement = FindMovement(speed, 0.0, 2.0, {});
  for (size_t i = 160; i < 166; ++i) {
    speed.states[i] = SampleState::kInvalid;
    speed.At(i) = std::nan("");
  }
  EXPECT_EQ(FindPhases(speed, movement).reacceleration.missing,
            "the wrist is hidden while it slows down");
  EXPECT_EQ(FindPhases(speed, Movement()).reacceleration.missing,
            "the movement has no onset or no end");
}

}  // namespace
}  // namespace graspbench
