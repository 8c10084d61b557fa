#include "core/trial/grip/grip_threshold.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/random.h"

namespace graspbench {
namespace {

constexpr ThresholdRange kRange = {1.0, 16.0};

// Whatever the threshold, it is found within a sixteenth of the four octaves, from above.
TEST(GripThreshold, FindsAnyThresholdOfAMonotoneDraw) {
  RandomStream random("grip threshold", "test");
  for (int i = 0; i < 500; ++i) {
    const double truth = std::pow(2.0, random.NextUniform(0.01, 3.99));
    int num_asked = 0;
    const GripThreshold found = FindGripThreshold(kRange, [&](double grip) {
      ++num_asked;
      return grip >= truth;
    });
    EXPECT_LE(num_asked, kMostThresholdTrials);
    EXPECT_TRUE(found.is_monotone);
    EXPECT_GE(found.value, truth);
    EXPECT_LE(found.value, truth * std::pow(16.0, 1.0 / 16.0) * (1.0 + 1e-12));
  }
}

TEST(GripThreshold, SaysWhereTheRangeEnds) {
  const GripThreshold never = FindGripThreshold(kRange, [](double) { return false; });
  EXPECT_TRUE(std::isnan(never.value));
  EXPECT_EQ(never.failed.size(), 1u);
  const GripThreshold always = FindGripThreshold(kRange, [](double) { return true; });
  EXPECT_EQ(always.value, kRange.least);
  EXPECT_TRUE(always.is_below_range);
  const GripThreshold only_most =
      FindGripThreshold(kRange, [](double grip) { return grip == kRange.most; });
  EXPECT_EQ(only_most.value, kRange.most);
}

// Held with 2 to 3 and from 12 on: bisection goes to the lower threshold and names the draw.
TEST(GripThreshold, NamesADrawThatFailsAgainAbove) {
  const GripThreshold found = FindGripThreshold(
      kRange, [](double grip) { return (grip >= 1.5 && grip <= 4.1) || grip >= 12.0; });
  EXPECT_FALSE(found.is_monotone);
  EXPECT_GE(found.value, 1.5);
  EXPECT_LE(found.value, 4.1);
}

}  // namespace
}  // namespace graspbench
