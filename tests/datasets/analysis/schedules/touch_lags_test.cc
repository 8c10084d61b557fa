#include "datasets/analysis/schedules/touch_lags.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <random>

namespace graspbench {
namespace {

const std::vector<std::string> kDigits = {"TH", "FF", "MF"};

/** Trials that differ in clock and closing time; their digits touch at these shares of it, give or
take a scatter that is symmetric over the trials. */
std::vector<TrialTouches> MakeTrials(const std::map<std::string, double>& shares, int count,
                                     double scatter) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> clock(1.0, 9.0), closing(0.2, 0.5);
  double latest = 0.0;
  for (const auto& [digit, share] : shares) latest = std::max(latest, share);
  std::vector<TrialTouches> trials;
  for (int k = 0; k < count; ++k) {
    TrialTouches trial = {"can", clock(random), {}};
    const double length = closing(random);
    for (const auto& [digit, share] : shares) {
      // The first and the last digit do not scatter, so that they span what was planted.
      const bool is_between = share > 0.0 && share < latest;
      const double off = is_between ? scatter * (k - 0.5 * (count - 1)) / count : 0.0;
      trial.contacts.push_back(
          {digit, digit == "TH", trial.start + length * (1.0 - latest + share + off)});
    }
    trials.push_back(trial);
  }
  return trials;
}

TEST(TouchLags, PlantedSharesComeBackWhateverTheClockAndTheClosingTime) {
  const auto trials = MakeTrials({{"TH", 0.25}, {"FF", 0.0}, {"MF", 0.1}}, 21, 0.08);
  const Answer<TouchLags> lags = SummariseTouches(trials, kDigits);
  ASSERT_TRUE(lags) << lags.reason();
  EXPECT_EQ(lags->num_trials, 21);
  EXPECT_NEAR(lags->Of("TH").median, 0.25, 1e-12);
  EXPECT_NEAR(lags->Of("FF").median, 0.0, 1e-12);
  EXPECT_NEAR(lags->Of("MF").median, 0.1, 1e-12);
  EXPECT_NEAR(lags->Of("TH").high - lags->Of("TH").low, 0.0, 1e-12);
  // Quartiles of 21 even steps of 0.08 / 21 about 0.1: 5 steps to each side.
  EXPECT_NEAR(lags->Of("MF").low, 0.1 - 5.0 * 0.08 / 21.0, 1e-12);
  EXPECT_NEAR(lags->Of("MF").high, 0.1 + 5.0 * 0.08 / 21.0, 1e-12);
}

TEST(TouchLags, OnlyTheDigitsThatAreAskedForDecideWhoIsFirstAndLast) {
  const auto trials =
      MakeTrials({{"TH", 0.25}, {"FF", 0.05}, {"MF", 0.1}, {"LF", 0.0}, {"RF", 0.3}}, 4, 0.0);
  const Answer<TouchLags> lags = SummariseTouches(trials, kDigits);
  ASSERT_TRUE(lags);
  // Without the little and the ring finger closing takes 0.95 of what it took with them.
  EXPECT_NEAR(lags->Of("TH").median, 0.2 / 0.95, 1e-12);
  EXPECT_NEAR(lags->Of("FF").median, 0.0, 1e-12);
}

TEST(TouchLags, ADigitThatNeverTouchesIsTheLastAndNoneIsDropped) {
  auto trials = MakeTrials({{"TH", 0.25}, {"FF", 0.0}, {"MF", 0.1}}, 4, 0.0);
  trials[0].contacts[1].time = NAN;  // by id: FF, MF, TH
  Answer<TouchLags> lags = SummariseTouches(trials, kDigits);
  ASSERT_TRUE(lags);
  EXPECT_EQ(lags->num_trials, 4);
  EXPECT_EQ(lags->Of("MF").num_never, 1);
  EXPECT_NEAR(lags->Of("MF").median, 0.1, 1e-12);
  EXPECT_TRUE(std::isinf(lags->Of("MF").high));
  EXPECT_FALSE(std::isinf(lags->gft));
  for (TrialTouches& trial : trials) trial.contacts[1].time = NAN;
  lags = SummariseTouches(trials, kDigits);
  ASSERT_TRUE(lags);
  EXPECT_TRUE(std::isinf(lags->Of("MF").median));
  EXPECT_TRUE(std::isinf(lags->gft));
  const TouchLags read = TouchLagsFromJson(ToJson(*lags));
  EXPECT_EQ(ToJson(read), ToJson(*lags));
  EXPECT_TRUE(std::isinf(read.Of("MF").median));
  for (TrialTouches& trial : trials) {
    for (DigitContact& contact : trial.contacts) contact.time = NAN;
  }
  EXPECT_EQ(SummariseTouches(trials, kDigits).reason(), "no digit touched in any trial");
}

TEST(TouchLags, WhatCannotBeComparedIsLeftOutAndCounted) {
  auto trials = MakeTrials({{"TH", 0.25}, {"FF", 0.0}, {"MF", 0.1}}, 4, 0.0);
  trials[0].start = NAN;
  trials[1].contacts.pop_back();                        // not known
  trials[2].start = trials[2].contacts[0].time + 0.01;  // it touched before
  const Answer<TouchLags> lags = SummariseTouches(trials, kDigits);
  ASSERT_TRUE(lags);
  EXPECT_EQ(lags->num_trials, 1);
  EXPECT_EQ(lags->num_left_out, 3);
  trials.pop_back();
  EXPECT_EQ(SummariseTouches(trials, kDigits).reason(),
            "none of 3 trials has a known start of closure and known contacts after it");
  EXPECT_EQ(SummariseTouches(trials, {"TH", "LF", "RF"}).reason(), "no contact is known of LF, RF");
  EXPECT_EQ(SummariseTouches({}, kDigits).reason(), "there is no trial");
}

TEST(TouchLags, TimesInMillisecondsAreRefused) {
  auto trials = MakeTrials({{"TH", 0.25}, {"FF", 0.0}, {"MF", 0.1}}, 4, 0.0);
  for (TrialTouches& trial : trials) {
    trial.start *= 1000.0;
    for (DigitContact& contact : trial.contacts) contact.time *= 1000.0;
  }
  const Answer<TouchLags> lags = SummariseTouches(trials, kDigits);
  ASSERT_FALSE(lags);
  EXPECT_NE(lags.reason().find("are its times in seconds?"), std::string::npos) << lags.reason();
}

}  // namespace
}  // namespace graspbench
