/** @file
The generators keep their own promises: nobody would notice if they did not. */

#include "tests/human_study/protocol/reaches.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/statistics/summary.h"

namespace graspbench::protocol {
namespace {

Conditions MakeExact() {
  Conditions conditions;
  conditions.noise_sd = 0.0;
  conditions.rate = 1000.0;
  return conditions;
}

Eigen::Vector3d FindAxis(const Reach& reach, size_t i) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const auto& marker : reach.object_markers) sum += marker[i];
  return sum / static_cast<double>(reach.object_markers.size());
}

// A marker's way to the axis stops within what the skin yields, and it did not stop before.
TEST(Reaches, SkinAndSurfaceMeetAtTheStatedTouch) {
  const struct {
    ReachMaker make_reach;
    double push, pad_depth, coming, sinking;  // [m]
  } cases[] = {{MakeProtocolReach, 0.0, 0.0, 0.8e-3, 0.6e-3},
               {MakeStrangerReach, 0.0, 0.0, 0.8e-3, 0.5e-3},
               {MakePushedReach, 5e-3, 0.0, 0.3e-3, 0.8e-3},
               {MakePushedReach, 5e-3, 0.5e-3, 0.3e-3, 2e-3}};
  for (const auto& c : cases) {
    Conditions conditions = MakeExact();
    conditions.push = c.push;
    conditions.pad_depth = c.pad_depth;
    for (int trial = 0; trial < 4; ++trial) {
      const Reach reach = c.make_reach(conditions, "meets", trial);
      for (size_t d = 0; d < kNumDigits; ++d) {
        const auto off_axis = [&](double t) {
          const auto i = static_cast<size_t>(std::lround(t * conditions.rate));
          return (reach.digits[d][i] - FindAxis(reach, i)).head<2>().norm();
        };
        const double touch = reach.touch_times[d];
        EXPECT_GT(off_axis(touch - 0.02), off_axis(touch) + c.coming);
        EXPECT_GT(off_axis(touch + 0.05), off_axis(touch) - c.sinking);
        EXPECT_LT(touch, reach.lift_off);
      }
    }
  }
}

TEST(EverydayReach, ProfilesArePeakedWhereStated) {
  for (const auto family : {SpeedProfile::Family::kWarped, SpeedProfile::Family::kBeta,
                            SpeedProfile::Family::kHalves}) {
    for (const double peak : {0.42, 0.5, 0.58}) {
      const SpeedProfile profile(family, peak);
      double best = 0.0, fastest = 0.0;
      for (double u = 0.0; u < 1.0; u += 0.005) {
        const double speed = profile.PositionAt(u + 0.005) - profile.PositionAt(u);
        EXPECT_GE(speed, 0.0);
        if (speed > fastest) fastest = speed, best = u + 0.0025;
      }
      EXPECT_NEAR(best, peak, 0.011);
      EXPECT_NEAR(profile.PositionAt(1.0 - 1e-9), 1.0, 1e-6);
    }
  }
}

// No force, no motion; and a push is what the first digit's plan asks, but for what the others do.
TEST(PushedReach, TheObjectRestsUntilItIsTouchedAndGoesAsFarAsItIsPushed) {
  for (const double push : {0.0, 5e-3, 15e-3}) {
    Conditions conditions = MakeExact();
    conditions.push = push;
    for (int trial = 0; trial < 4; ++trial) {
      const Reach reach = MakePushedReach(conditions, "pushed", trial);
      const double first = *std::min_element(reach.touch_times.begin(), reach.touch_times.end());
      double farthest = 0.0;
      for (size_t i = 0; reach.times[i] < reach.lift_off; ++i) {
        const double moved = (FindAxis(reach, i) - FindAxis(reach, 0)).norm();
        if (reach.times[i] <= first) {
          EXPECT_LT(moved, 1e-12);
        }
        farthest = std::max(farthest, moved);
      }
      EXPECT_GE(farthest, push > 0.0 ? 2e-3 : 0.0);  // others may stop it
      EXPECT_LE(farthest, 1.5 * push + 1e-4);
    }
  }
}

TEST(StrangerReach, TheHandIsFastestWhereStatedAndStandsAtBothEnds) {
  for (const double peak : {0.42, 0.5, 0.57}) {
    Conditions conditions = MakeExact();
    conditions.min_peak = conditions.max_peak = peak;
    for (const char* person : {"a", "b", "c", "d"}) {
      const Reach reach = MakeStrangerReach(conditions, person, 0);
      const auto step = [&](size_t i) { return (reach.wrist[i + 1] - reach.wrist[i]).norm(); };
      size_t first = 0, last = 0, best = 0;
      for (size_t i = 0; reach.times[i + 2] < reach.lift_off; ++i) {
        if (step(i) > 1e-9 && first == 0) first = i;
        if (step(i) > 1e-9) last = i;
        if (step(i) > step(best)) best = i;
      }
      EXPECT_NEAR(reach.times[first], reach.onset, 0.003);
      EXPECT_NEAR(double(best - first) / double(last - first), peak, 0.03) << person;
    }
  }
}

// Spread of each digit about the start, and no relation of one digit to another.
TEST(StrangerReach, DigitsScatterByThemselvesUnlessTheyShareADelay) {
  for (const double shared : {0.0, 0.06}) {
    Conditions conditions = MakeExact();
    conditions.rate = 20.0;
    conditions.shared_sd = shared;
    std::vector<double> thumb, index;
    for (int trial = 0; trial < 400; ++trial) {
      const Reach reach = MakeStrangerReach(conditions, "scatter", trial);
      thumb.push_back(reach.touch_times[0] - reach.onset);
      index.push_back(reach.touch_times[1] - reach.onset);
    }
    const Moments a = CalcMoments(thumb), b = CalcMoments(index);
    double covariance = 0.0;
    for (size_t i = 0; i < thumb.size(); ++i) {
      covariance += (thumb[i] - a.mean) * (index[i] - b.mean) / 399.0;
    }
    EXPECT_NEAR(std::sqrt(a.sum_of_squares / 399.0), std::hypot(0.025, shared), 0.004);
    EXPECT_NEAR(covariance, shared * shared, shared > 0.0 ? 0.0008 : 0.0001);
  }
}

}  // namespace
}  // namespace graspbench::protocol
