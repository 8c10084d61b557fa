#include "tests/human_study/protocol/stranger_reach.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/statistics/summary.h"

namespace graspbench::everyday {
namespace {

TEST(StrangerReach, SkinAndSurfaceMeetAtTheStatedTouch) {
  Conditions conditions;
  conditions.noise_sd = 0.0;
  conditions.rate = 1000.0;
  for (int trial = 0; trial < 6; ++trial) {
    const Reach reach = MakeStrangerReach(conditions, "meets", trial);
    for (size_t d = 0; d < kNumDigits; ++d) {
      const auto off_axis = [&](double t) {
        const size_t i = static_cast<size_t>(std::lround(t * conditions.rate));
        const Eigen::Vector3d axis =
            (reach.object_markers[0][i] + reach.object_markers[1][i] + reach.object_markers[2][i]) /
            3.0;
        return (reach.digits[d][i] - axis).head<2>().norm();
      };
      const double touch = reach.touch_times[d];
      EXPECT_GT(off_axis(touch - 0.02), off_axis(touch) + 0.0008);
      EXPECT_NEAR(off_axis(touch + 0.05), off_axis(touch), 0.0005);
      EXPECT_LT(touch, reach.lift_off);
    }
  }
}

TEST(StrangerReach, TheHandIsFastestWhereStatedAndStandsAtBothEnds) {
  for (const double peak : {0.42, 0.5, 0.57}) {
    Conditions conditions;
    conditions.noise_sd = 0.0;
    conditions.rate = 1000.0;
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
    Conditions conditions;
    conditions.noise_sd = 0.0;
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
}  // namespace graspbench::everyday
