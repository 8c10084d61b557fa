#include "core/optimise/contact_times.h"

#include <gtest/gtest.h>

#include <cmath>

namespace graspbench {
namespace {

LearningTrial MakeTouches(double thumb, double index, double middle) {
  LearningTrial trial;
  trial.contacts = {{"TH", true, thumb}, {"FF", false, index}, {"MF", false, middle}};
  trial.timing = CalcContactTiming(trial.contacts, 0.0);
  return trial;
}

// By hand: GFT 100, 120 and 140 ms, GOT 100, 90 and 80, GCT 500, 510 and 520; two trials have none.
TEST(SummariseContactTimes, AreMediansOfTheTrialsThatHaveTimes) {
  const std::vector<LearningTrial> trials = {
      MakeTouches(0.4, 0.5, 0.5), MakeTouches(0.39, 0.48, 0.51), MakeTouches(0.38, 0.46, 0.52),
      MakeTouches(0.4, 0.5, kUnset), MakeTouches(-0.01, 0.5, 0.5)};
  const ContactTimesSummary times = SummariseContactTimes(trials);
  EXPECT_EQ(times.num_trials, 5);
  EXPECT_EQ(times.num_timed, 3);
  EXPECT_NEAR(times.gft, 0.12, 1e-12);
  EXPECT_NEAR(times.got, 0.09, 1e-12);
  EXPECT_NEAR(times.gct, 0.51, 1e-12);
  EXPECT_TRUE(std::isnan(times.gft_floor));  // of fewer than five trials
}

// Digits that are late by constants have no scatter; a thumb that scatters by 10 ms about its
// median keeps that, because the others come when it does in the median.
TEST(SummariseContactTimes, TheFloorIsWhatScattersFromTrialToTrial) {
  std::vector<LearningTrial> constant, scattered;
  for (const double shift : {-0.02, -0.01, 0.0, 0.01, 0.02}) {
    constant.push_back(MakeTouches(0.4 + shift, 0.5 + shift, 0.55 + shift));
    scattered.push_back(MakeTouches(0.4 + shift, 0.5, 0.55));
  }
  EXPECT_NEAR(SummariseContactTimes(constant).gft_floor, 0.0, 1e-12);
  EXPECT_NEAR(SummariseContactTimes(scattered).gft_floor, 0.01, 1e-12);  // of 0, 10, 10, 20, 20
}

TEST(SummariseContactTimes, WithoutTrialsNothingIsKnown) {
  EXPECT_TRUE(std::isnan(SummariseContactTimes({}).gft));
}

}  // namespace
}  // namespace graspbench
