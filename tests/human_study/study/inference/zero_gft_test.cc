#include "human_study/study/inference/zero_gft.h"

#include <gtest/gtest.h>

#include "human_study/study/run/run_study.h"

namespace graspbench {
namespace {

std::vector<StudyTrial> MakeTrials(int num_trials, int num_digits, double uncertainty) {
  std::vector<StudyTrial> trials(static_cast<size_t>(num_trials));
  for (size_t i = 0; i < trials.size(); ++i) {
    trials[i].id = "p1-" + std::to_string(i);
    trials[i].analysis.emplace();
    for (int d = 0; d < num_digits; ++d) {
      DigitContactEvents& digit = trials[i].analysis->contacts.emplace_back();
      digit.contact.time = 1.0;
      digit.own_uncertainty = uncertainty;
    }
  }
  return trials;
}

// The range of two normal numbers is the size of one with root two times their deviation.
TEST(CalcZeroGft, OfTwoDigitsIsThatOfADifference) {
  const ZeroGft zero = CalcZeroGft(MakeTrials(200, 2, 0.01));
  EXPECT_EQ(zero.num_trials, 200);
  EXPECT_NEAR(zero.median, 0.67449 * std::sqrt(2.0) * 0.01, 0.0004);
  EXPECT_NEAR(zero.limit, 1.95996 * std::sqrt(2.0) * 0.01, 0.0008);
}

// Tippett's mean range of five is 2.326 deviations; the median lies a little below.
TEST(CalcZeroGft, OfFiveDigitsIsTheRangeOfFive) {
  EXPECT_NEAR(CalcZeroGft(MakeTrials(200, 5, 0.01)).median, 0.0226, 0.0006);
}

TEST(CalcZeroGft, TrialsThatDoNotCountOrHaveOneContactTakeNoPart) {
  std::vector<StudyTrial> trials = MakeTrials(3, 2, 0.01);
  trials[0].removed = "a reason";
  trials[1].analysis->contacts[0].contact = MissingEvent("hidden");
  EXPECT_EQ(CalcZeroGft(trials).num_trials, 1);
  trials.pop_back();
  EXPECT_TRUE(std::isnan(CalcZeroGft(trials).median));
}

}  // namespace
}  // namespace graspbench
