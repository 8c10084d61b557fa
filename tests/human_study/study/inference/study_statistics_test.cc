#include "human_study/study/inference/study_statistics.h"

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

StudyTrial MakeTrial(const std::string& participant,
                     const std::vector<std::vector<std::string>>& groups, int num_ties) {
  StudyTrial trial;
  trial.participant = participant;
  trial.analysis.emplace();
  trial.analysis->order.groups = groups;
  trial.analysis->order.num_ties = num_ties;
  for (const auto& group : groups) {
    trial.analysis->num_touching += static_cast<int>(group.size());
  }
  return trial;
}

// Counted by hand.
TEST(SummariseOrders, CountsFirstDigitsPrecedenceAndTies) {
  StudyResult result;
  result.digits = {"TH", "FF", "MF"};
  result.trials = {MakeTrial("a", {{"TH"}, {"FF"}, {"MF"}}, 0),
                   MakeTrial("a", {{"FF", "TH"}, {"MF"}}, 1),
                   MakeTrial("b", {{"TH"}, {"MF", "FF"}}, 1), MakeTrial("b", {{"MF"}}, 0)};
  result.trials.back().removed = "no contact";
  result.trials.push_back(MakeTrial("b", {{"TH"}, {"FF", "MF"}}, 1));
  const OrderSummary summary = SummariseOrders(result);
  ASSERT_EQ(summary.first.size(), 2u);
  EXPECT_EQ(summary.first[0].participant, "a");
  EXPECT_EQ(summary.first[0].counts, (std::vector<int>{1, 0, 0, 1}));
  EXPECT_EQ(summary.first[1].counts, (std::vector<int>{2, 0, 0, 0}));
  EXPECT_EQ(summary.precedence[0][1].num_before, 3);
  EXPECT_EQ(summary.precedence[0][1].num_both, 4);
  EXPECT_DOUBLE_EQ(summary.precedence[0][1].share(), 0.75);
  EXPECT_EQ(summary.precedence[1][0].num_before, 0);
  EXPECT_EQ(summary.precedence[1][2].num_before, 2);
  EXPECT_EQ(summary.num_ties, 3);
  EXPECT_EQ(summary.num_neighbours, 8);
  ASSERT_EQ(summary.orders.size(), 3u);
  EXPECT_EQ(summary.orders[0].order, "TH<FF=MF");  // however the tied digits were listed
  EXPECT_EQ(summary.orders[0].count, 2);
  EXPECT_DOUBLE_EQ(summary.orders[0].share, 0.5);
}

/** Two people and two weights; contact to lift is 0.1 s and 0.4 s per kg. */
StudyResult MakeLifts() {
  StudyResult result;
  result.study.factors = {{"mass_kg", {"0.2", "0.6"}, {0.2, 0.6}, ""}};
  for (const char* person : {"P1", "P2"}) {
    for (const char* level : {"0.2", "0.6"}) {
      StudyTrial trial;
      trial.participant = person;
      trial.levels = {level};
      trial.analysis.emplace();
      DigitContactEvents digit;
      digit.contact.time = 1.0;
      trial.analysis->contacts = {digit};
      const double own = std::string(person) == "P1" ? 0.0 : 0.02;
      trial.analysis->object.lift_off.time = 1.0 + 0.1 + own + (0.4 + own) * std::stod(level);
      trial.analysis->closure_start_value = 0.1;
      result.trials.push_back(trial);
    }
  }
  return result;
}

TEST(ComparePublished, ContactToLiftStandsWithItsGrowthByWeight) {
  const std::vector<ComparedValue> compared = ComparePublished(MakeLifts());
  int num_medians = 0, num_slopes = 0;
  for (const ComparedValue& value : compared) {
    if (std::string(value.published->measure) != "contact_to_lift_s") {
      EXPECT_FALSE(value.published->is_slope) << "no size was varied";
      continue;
    }
    if (value.published->is_slope) {
      ++num_slopes;
      EXPECT_EQ(value.factor, "mass_kg");
      ASSERT_TRUE(value.slopes.test);
      EXPECT_NEAR(value.slopes.test->mean, 0.41, 1e-9);
    } else {
      ++num_medians;
      ASSERT_TRUE(value.summary);
      EXPECT_EQ(value.summary->count, 4);
    }
  }
  EXPECT_EQ(num_medians, 1);
  EXPECT_EQ(num_slopes, 1);
}

TEST(ComparePublished, AStudyWithoutATrialSaysNothing) {
  StudyResult result = MakeLifts();
  for (StudyTrial& trial : result.trials) trial.removed = "late";
  EXPECT_TRUE(ComparePublished(result).empty());
}

TEST(PublishedValues, EveryOneIsAMeasureWithASource) {
  for (const PublishedValue& value : PublishedValueList()) {
    EXPECT_NO_THROW(FindMeasure(value.measure));
    EXPECT_FALSE(std::string(value.source).empty());
  }
}

}  // namespace
}  // namespace graspbench
