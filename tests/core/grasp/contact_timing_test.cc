#include "core/grasp/contact_timing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/base/random.h"

namespace graspbench {
namespace {

constexpr double kNeverTouches = std::numeric_limits<double>::quiet_NaN();

// Times in eighths of a second are exact in binary, so the expected differences are exact too.
std::vector<DigitContact> MakeHand(double thumb, const std::vector<double>& fingers) {
  std::vector<DigitContact> contacts{{"TH", true, thumb}};
  const char* const names[] = {"FF", "MF", "RF", "LF"};
  for (size_t i = 0; i < fingers.size(); ++i) contacts.push_back({names[i], false, fingers[i]});
  return contacts;
}

// By hand. The thumb opposes the first finger to arrive, not the closest in time; what came before
// the start is reported, not clipped.
TEST(ContactTiming, OfHandsByHand) {
  constexpr double kNone = kNeverTouches;
  struct Case {
    const char* what;
    std::vector<DigitContact> contacts;
    double t0, gct, gft, got, gft_ratio, got_ratio;
    bool is_early;
  };
  const Case cases[] = {
      {"thumb first", MakeHand(0.25, {0.5, 0.375, 0.75}), 0.0, 0.75, 0.5, 0.125, 2.0 / 3.0,
       1.0 / 6.0, false},
      {"thumb last", MakeHand(1.0, {0.5, 0.625}), 0.25, 0.75, 0.5, 0.5, 2.0 / 3.0, 2.0 / 3.0,
       false},
      {"thumb between", MakeHand(0.5, {0.125, 0.625}), 0.0, 0.625, 0.5, 0.375, 0.8, 0.6, false},
      {"two digits", MakeHand(0.75, {0.25}), 0.125, 0.625, 0.5, 0.5, 0.8, 0.8, false},
      {"a finger never", MakeHand(0.25, {0.5, kNone}), 0.0, kNone, kNone, 0.25, kNone, kNone,
       false},
      {"thumb never", MakeHand(kNone, {0.5, 0.75}), 0.0, kNone, kNone, kNone, kNone, kNone, false},
      {"fingers never", MakeHand(0.5, {kNone, kNone}), 0.0, kNone, kNone, kNone, kNone, kNone,
       false},
      {"no thumb",
       {{"FF", false, 0.25}, {"MF", false, 0.75}},
       0.125,
       0.625,
       0.5,
       kNone,
       0.8,
       kNone,
       false},
      {"no digits", {}, 0.0, kNone, kNone, kNone, kNone, kNone, false},
      {"all at the start", MakeHand(2.0, {2.0, 2.0}), 2.0, 0.0, 0.0, 0.0, kNone, kNone, false},
      {"one early", MakeHand(0.25, {0.75, 1.0}), 0.5, 0.5, 0.75, 0.5, 1.5, 1.0, true},
      {"all early", MakeHand(0.25, {0.375}), 0.5, -0.125, 0.125, 0.125, kNone, kNone, true}};
  for (const Case& c : cases) {
    const ContactTiming timing = CalcContactTiming(c.contacts, c.t0);
    const std::pair<double, double> pairs[] = {{timing.gct, c.gct},
                                               {timing.gft, c.gft},
                                               {timing.got, c.got},
                                               {timing.gft_ratio, c.gft_ratio},
                                               {timing.got_ratio, c.got_ratio}};
    for (const auto& [found, expected] : pairs) {
      EXPECT_TRUE(std::isnan(expected) ? std::isnan(found) : found == expected)
          << c.what << ": " << found << ", expected " << expected;
    }
    EXPECT_EQ(timing.contact_before_start, c.is_early) << c.what;
  }
}

// GCT >= GFT >= GOT for every hand that touches after the start, and the order of the digits and
// the zero of the clock do not matter.
TEST(ContactTiming, OrderOfTheThreeMeasures) {
  RandomStream stream("contact timing", "order");
  for (int i = 0; i < 2000; ++i) {
    const double t0 = stream.NextUniform(-1.0, 1.0);
    std::vector<double> fingers(1 + stream.NextIndex(4));
    for (double& time : fingers) time = t0 + stream.NextUnit();
    std::vector<DigitContact> contacts = MakeHand(t0 + stream.NextUnit(), fingers);
    const ContactTiming timing = CalcContactTiming(contacts, t0);
    ASSERT_GE(timing.gct, timing.gft);
    ASSERT_GE(timing.gft, timing.got);
    ASSERT_GE(timing.got, 0.0);
    ASSERT_LE(timing.gft_ratio, 1.0);
    if (fingers.size() == 1) {
      ASSERT_EQ(timing.gft, timing.got);
    }

    std::swap(contacts.front(), contacts.back());
    for (DigitContact& contact : contacts) contact.time += 8.0;
    const ContactTiming later = CalcContactTiming(contacts, t0 + 8.0);
    ASSERT_NEAR(later.gct, timing.gct, 1e-14);
    ASSERT_NEAR(later.gft, timing.gft, 1e-14);
    ASSERT_NEAR(later.got, timing.got, 1e-14);
  }
}

TEST(ContactTimingDeathTest, TwoThumbsAreABug) {
  EXPECT_DEATH(CalcContactTiming({{"TH", true, 0.1}, {"T2", true, 0.2}}, 0.0),
               "opposing digits: 2");
}

constexpr double kNever = std::numeric_limits<double>::quiet_NaN();

TEST(ContactOrder, NeighboursWithinTheirUncertaintyAreTied) {
  // 10 ms against 1.96 * 5 ms; 9 ms against 1.96 * 4.24 ms.
  const ContactOrder order = FindContactOrder({{"TH", true, 1.000},
                                               {"FF", false, 0.990},
                                               {"MF", false, 1.050},
                                               {"RF", false, kNever},
                                               {"LF", false, 1.059}},
                                              {0.004, 0.003, 0.003, 0.0, 0.003});
  EXPECT_EQ(order.Format(), "FF<TH<MF<LF");
  EXPECT_EQ(order.num_ties, 0);
  EXPECT_EQ(order.FindRank("FF"), 1);
  EXPECT_EQ(order.FindRank("LF"), 4);
  EXPECT_EQ(order.FindRank("RF"), 0);

  const ContactOrder tied = FindContactOrder(
      {{"TH", true, 1.000}, {"FF", false, 0.990}, {"MF", false, 2.0}}, {0.006, 0.003, 0.003});
  EXPECT_EQ(tied.Format(), "FF=TH<MF");
  EXPECT_EQ(tied.num_ties, 1);
  EXPECT_EQ(tied.FindRank("TH"), 1);
  EXPECT_EQ(tied.FindRank("MF"), 2);
}

TEST(ContactOrder, ExactTimesAreTiedWhenEqualAndOfNothingThereIsNone) {
  EXPECT_EQ(FindContactOrder({{"TH", true, 1.0}, {"FF", false, 1.0}}, {0.0, 0.0}).Format(),
            "TH=FF");
  EXPECT_EQ(FindContactOrder({{"TH", true, 1.0 + 1e-15}, {"FF", false, 1.0}}, {0.0, 0.0}).Format(),
            "FF<TH");
  EXPECT_EQ(FindContactOrder({{"TH", true, kNever}}, {kNever}).Format(), "");
  EXPECT_TRUE(FindContactOrder({}, {}).groups.empty());
}

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
