#include "human_study/events/approach.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/base/random.h"
#include "human_study/events/reach_trial.h"
#include "tests/human_study/events/trajectories.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;

constexpr double kTouch = 1.0;
const Hold kHold = {1.3, 1.2, 1.6, ""};

/** Along -y at 0.1 m/s to a place 43 mm from the axis, there until the end. */
Trajectory MakePath(double rate) {
  return SamplePath(MakeTimes(0.0, 1.6, rate), [](double t) {
    return Vector3d(0.0, 0.043 + 0.1 * std::max(0.0, kTouch - t), 0.01);
  });
}

TEST(FindHoldPlace, IsTheMedianOfMeasuredSamplesAboutTheHold) {
  Trajectory path = MakePath(100.0);
  path.p.col(130) += Vector3d(0.5, 0.0, 0.0);  // one bad sample
  EXPECT_LT((FindHoldPlace(path, kHold) - Vector3d(0.0, 0.043, 0.01)).norm(), 1e-9);
  HideSamples(path, 1.1, 1.55);
  EXPECT_LT((FindHoldPlace(path, kHold) - Vector3d(0.0, 0.043, 0.01)).norm(), 1e-9);
  HideSamples(path, 1.1, 1.6);
  EXPECT_TRUE(FindHoldPlace(path, kHold).hasNaN());
}

TEST(TakeApproach, TheBracketHoldsTheTouchAndPlacesEndAtZero) {
  const SurfaceDistance distance = MakeCylinderDistance(0.035, 0.12);
  for (const double rate : {60.0, 100.0, 500.0}) {
    const Trajectory path = MakePath(rate);
    const Vector3d place = FindHoldPlace(path, kHold);
    for (const TouchSamples& samples :
         {TakeApproachToSurface(path, distance, place, kHold, 2e-4, std::nan("")),
          TakeApproachToPlace(path, place, kHold, 2e-4)}) {
      ASSERT_GE(samples.times.size(), 8u) << rate;
      EXPECT_LT(samples.first, kTouch - 0.03);
      EXPECT_GT(samples.last, kTouch);
      EXPECT_LT(samples.last, kTouch + 0.06);
      EXPECT_NEAR(samples.places.back(), 0.0, 1e-9);
      for (size_t i = 0; i < samples.times.size(); ++i) {
        if (samples.times[i] > kTouch - 0.005) continue;
        EXPECT_NEAR(samples.places[i], 0.1 * (kTouch - samples.times[i]), 1e-5) << rate;
      }
    }
  }
}

TEST(TakeApproach, FilledSamplesTakeNoPart) {
  Trajectory path = MakePath(100.0);
  const SampleRun hidden = FindSamples(path.times, kTouch - 0.035, kTouch + 0.055);
  for (size_t i = hidden.first; i < hidden.last; ++i) {
    path.states[i] = SampleState::kFilled;
    path.At(i).y() = 0.044;
  }
  const TouchSamples samples = TakeApproachToPlace(path, FindHoldPlace(path, kHold), kHold, 2e-4);
  for (const double time : samples.times) {
    EXPECT_TRUE(time < kTouch - 0.034 || time > kTouch + 0.054) << time;
  }
  EXPECT_LT(samples.first, kTouch - 0.03);
  EXPECT_GT(samples.last, kTouch + 0.03);
}

/** Comes along -y until 0.9 s, closes along -x at 50 mm/s until the touch, and sways by `noise`. */
Trajectory MakeTurningPath(double noise) {
  RandomStream random("approach", "turning");
  Trajectory path = SamplePath(MakeTimes(0.0, 1.6, 200.0), [](double t) {
    const double early = std::max(0.0, 0.9 - t);
    return Vector3d(0.043 + std::min(0.02, 0.05 * std::max(0.0, kTouch - t)), -0.8 * early * early,
                    0.01);
  });
  for (Eigen::Index i = 0; i < path.p.size(); ++i) path.p.data()[i] += noise * random.NextNormal();
  return path;
}

// Long before, the tip passes the plane through its place, 0.1 m beside it.
TEST(TakeApproach, TheTouchIsNotLookedForFarBesideThePlace) {
  for (const double noise : {1e-4, 1e-3, 2e-3}) {
    const Trajectory path = MakeTurningPath(noise);
    const Vector3d place = FindHoldPlace(path, kHold);
    const TouchSamples samples = TakeApproachToPlace(path, place, kHold, noise);
    ASSERT_FALSE(samples.times.empty()) << noise;
    EXPECT_GT(samples.first, 0.7) << noise;
  }
}

TEST(FindLateMotion, TellsAStopFromATurnAndFromTheLastStop) {
  const double noise = 1e-4;
  const Trajectory path = MakeTurningPath(noise);
  const Vector3d place = FindHoldPlace(path, kHold);
  // Where the way along y ends, 5 mm along x are left, which it was closing already.
  const LateMotion early = FindLateMotion(path, place, kHold, noise, 0.9, -Vector3d::UnitY());
  EXPECT_EQ(early.share, 0.5);
  EXPECT_GT(early.from.x(), 0.99);
  EXPECT_NEAR(early.way, 0.004, 0.0003);
  EXPECT_EQ(FindLateMotion(path, place, kHold, noise, kTouch, Vector3d::UnitX()).share, 0.0);
  EXPECT_EQ(FindLateMotion(path, place, kHold, noise, 0.8, -Vector3d::UnitY()).share, 1.0);
}

TEST(TakeApproach, ATipThatWasAlwaysThereHasNone) {
  Trajectory path = MakePath(100.0);
  path.p.colwise() = Vector3d(0.0, 0.043, 0.0);
  EXPECT_TRUE(TakeApproachToPlace(path, FindHoldPlace(path, kHold), kHold, 2e-4).times.empty());
}

// A thumb touches at 0.1 m/s and sinks in by another 1.5 mm when the grip is built up 80 ms later.
// One that slows down evenly in the air and arrives softly made no earlier stop.
TEST(TakeEarlierStop, IsTheTouchBeforeTheGripAndNoSoftArrival) {
  for (const bool is_soft : {false, true}) {
    int num_stops = 0, num_right = 0;
    for (int run = 0; run < 50; ++run) {
      RandomStream random("stop " + std::to_string(run), is_soft ? "soft" : "sinks");
      TouchSamples samples;
      samples.noise = 0.2e-3;
      samples.first = 0.9;
      samples.last = 1.26;
      for (double t = 0.84; t < 1.34; t += 0.005) {
        const double left = std::max(0.0, kTouch - t), soft = std::max(0.0, 1.2 - t);
        const double grip = std::clamp((t - 1.08) / 0.12, 0.0, 1.0);
        const double sunk = 1.5e-3 * grip * grip * (3.0 - 2.0 * grip);
        const double place = is_soft ? 0.01 * soft + 0.5 * soft * soft : 0.1 * left + 1.5e-3 - sunk;
        samples.times.push_back(t);
        samples.places.push_back(place + samples.noise * random.NextNormal());
      }
      const TouchSamples stop = TakeEarlierStop(samples, is_soft ? 1.19 : 1.18);
      if (stop.times.empty()) continue;
      ++num_stops;
      num_right += stop.first < kTouch && stop.last > kTouch && stop.last < kTouch + 0.06 &&
                   std::abs(stop.places.back()) < 1e-3;
    }
    EXPECT_GE(num_right, is_soft ? 0 : 48);
    EXPECT_LE(num_stops, is_soft ? 2 : 50);
  }
}

}  // namespace
}  // namespace graspbench
