#include "tests/human_study/protocol/pushed_reach.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace graspbench::everyday {
namespace {

Conditions MakeExact(double push, double pad_depth) {
  Conditions conditions;
  conditions.noise_sd = 0.0;
  conditions.rate = 1000.0;
  conditions.push = push;
  conditions.pad_depth = pad_depth;
  return conditions;
}

Eigen::Vector3d FindAxis(const Reach& reach, size_t i) {
  return (reach.object_markers[0][i] + reach.object_markers[1][i] + reach.object_markers[2][i]) /
         3.0;
}

// No force, no motion; and a push is what the first digit's plan asks, but for what the others do.
TEST(PushedReach, TheObjectRestsUntilItIsTouchedAndGoesAsFarAsItIsPushed) {
  for (const double push : {0.0, 5e-3, 15e-3}) {
    for (int trial = 0; trial < 4; ++trial) {
      const Reach reach = MakePushedReach(MakeExact(push, 0.0), "pushed", trial);
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

// The marker's way to the axis stops within the skin's yield, and it did not stop before.
TEST(PushedReach, SkinAndSurfaceMeetAtTheStatedTouch) {
  for (const double pad_depth : {0.0, 0.5e-3}) {
    for (int trial = 0; trial < 4; ++trial) {
      const Reach reach = MakePushedReach(MakeExact(5e-3, pad_depth), "meets", trial);
      for (size_t d = 0; d < kNumDigits; ++d) {
        const auto off_axis = [&](double t) {
          const auto i = static_cast<size_t>(std::lround(t * 1000.0));
          return (reach.digits[d][i] - FindAxis(reach, i)).head<2>().norm();
        };
        const double touch = reach.touch_times[d];
        EXPECT_GT(off_axis(touch - 0.02), off_axis(touch) + 0.3e-3);
        EXPECT_GT(off_axis(touch + 0.05), off_axis(touch) - (pad_depth > 0.0 ? 2e-3 : 0.8e-3));
        EXPECT_LT(touch, reach.lift_off);
      }
    }
  }
}

}  // namespace
}  // namespace graspbench::everyday
