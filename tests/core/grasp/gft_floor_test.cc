#include "core/grasp/gft_floor.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/base/random.h"

namespace graspbench {
namespace {

using Trials = std::vector<std::vector<DigitContact>>;

const double kNeverTouched = std::nan("");

/** A row of times for each trial, the thumb first. */
Trials MakeTrials(const std::vector<std::vector<double>>& times) {
  const char* const names[] = {"TH", "FF", "MF", "RF"};
  Trials trials;
  for (const std::vector<double>& row : times) {
    trials.emplace_back();
    for (size_t i = 0; i < row.size(); ++i) {
      trials.back().push_back({names[i], i == 0, row[i]});
    }
  }
  return trials;
}

TEST(GftFloor, OfConstantLatenessIsZero) {
  std::vector<std::vector<double>> times;
  for (const double common : {0.0, 0.125, 0.25, 0.5, 0.0625}) {
    times.push_back({0.25 + common, 0.5 + common, 1.0 + common});
  }
  const Answer<double> floor = CalcGftFloor(MakeTrials(times));
  ASSERT_TRUE(floor) << floor.reason();
  EXPECT_EQ(*floor, 0.0);
}

// The thumb's median is 3, shifted to the finger's 11: GFT 2 1 0 1 2, GCT 11 11 11 12 13.
TEST(GftFloor, ByHand) {
  const Answer<double> floor =
      CalcGftFloor(MakeTrials({{1, 11}, {2, 11}, {3, 11}, {4, 11}, {5, 11}}));
  ASSERT_TRUE(floor) << floor.reason();
  EXPECT_DOUBLE_EQ(*floor, 1.0 / 11.0);
}

/** By its definition with loops and sorting, and nothing of the program's. */
double CalcByBruteForce(const std::vector<std::vector<double>>& times) {
  const auto sort_middle = [](std::vector<double> values) {
    std::sort(values.begin(), values.end());
    const size_t n = values.size();
    return n % 2 == 1 ? values[n / 2] : (values[n / 2 - 1] + values[n / 2]) / 2;
  };
  std::vector<double> middles, ratios;
  for (size_t i = 0; i < times[0].size(); ++i) {
    std::vector<double> column;
    for (const auto& row : times) column.push_back(row[i]);
    middles.push_back(sort_middle(column));
  }
  const double last = *std::max_element(middles.begin(), middles.end());
  for (const auto& row : times) {
    std::vector<double> shifted;
    for (size_t i = 0; i < row.size(); ++i) shifted.push_back(row[i] - middles[i]);
    const auto [low, high] = std::minmax_element(shifted.begin(), shifted.end());
    ratios.push_back((*high - *low) / (*high + last));
  }
  return sort_middle(ratios);
}

TEST(GftFloor, OfIndependentScatterIsWhatBruteForceGives) {
  RandomStream random("7", "scatter of digits");
  for (int k = 0; k < 50; ++k) {
    const int num_digits = 2 + random.NextIndex(3), num_trials = 5 + random.NextIndex(40);
    std::vector<std::vector<double>> times(static_cast<size_t>(num_trials));
    for (std::vector<double>& row : times) {
      for (int i = 0; i < num_digits; ++i) {
        row.push_back(0.3 + 0.2 * i + random.NextIndex(1000) * 1e-4);
      }
    }
    const Answer<double> floor = CalcGftFloor(MakeTrials(times));
    ASSERT_TRUE(floor) << floor.reason();
    EXPECT_NEAR(*floor, CalcByBruteForce(times), 1e-12);
    // How early an early digit is makes no difference.
    for (std::vector<double>& row : times) row[0] -= 0.15;
    EXPECT_NEAR(*CalcGftFloor(MakeTrials(times)), *floor, 1e-12);
  }
}

TEST(GftFloor, ATrialThatLacksAContactCountsAsInfinite) {
  const std::vector<std::vector<double>> touching = {{1, 11}, {2, 11}, {3, 11}, {4, 11}, {5, 11}};
  std::vector<std::vector<double>> times = touching;
  times.push_back({3, kNeverTouched});
  times.push_back({3, kNeverTouched});
  // 0, 1/12, 1/11, 2/13, 2/11 and twice infinity.
  EXPECT_DOUBLE_EQ(*CalcGftFloor(MakeTrials(times)), 2.0 / 13.0);
  Trials trials = MakeTrials(times);
  for (int i = 0; i < 3; ++i) trials.emplace_back();  // gave up
  EXPECT_EQ(CalcGftFloor(trials).reason(), "a digit did not touch in half of the trials or more");
}

TEST(GftFloor, IsNotKnownOfTooLittle) {
  EXPECT_EQ(CalcGftFloor({}).reason(), "fewer than two digits touched");
  EXPECT_EQ(
      CalcGftFloor(MakeTrials(std::vector<std::vector<double>>(9, {1.0, kNeverTouched}))).reason(),
      "fewer than two digits touched");
  EXPECT_EQ(CalcGftFloor(MakeTrials({{1, 2}, {1, 2}, {1, 2}, {1, 2}})).reason(),
            "all digits touched in 4 of the trials; expected 5 or more");
}

}  // namespace
}  // namespace graspbench
