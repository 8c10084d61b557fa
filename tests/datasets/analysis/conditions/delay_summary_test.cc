#include "datasets/analysis/conditions/delay_summary.h"

#include <gtest/gtest.h>

#include "tests/datasets/analysis/made_results.h"

namespace graspbench {
namespace {

/** Six objects of two trials; sigma falls by 2 N a second of delay in each, from where it is. */
std::vector<DelayedTrial> MakeTrials() {
  std::vector<DelayedTrial> trials;
  for (const TrialRecord& plain :
       MakeSession({"tum"}, {"a", "b", "c", "d", "e", "f"}, "g1", 2).records) {
    for (const double delay : ListDelays()) {
      TrialRecord record = plain;
      record.result.stability.sigma = 5.0 + record.plan.object[0] - 'a' - 2.0 * delay +
                                      0.01 * (record.plan.object[0] % 3) * delay;
      trials.push_back({"as run", "last", delay, {0.01 * delay, 0.0}, record});
    }
  }
  return trials;
}

const DoseResponse& Find(const std::vector<DoseResponse>& rows, const std::string& id) {
  for (const DoseResponse& row : rows) {
    if (row.response.id == id) return row;
  }
  throw std::runtime_error(id);
}

TEST(DelaySummary, FindsTheSlope) {
  const auto rows = SummariseDelays(MakeTrials());
  const DoseResponse& sigma = Find(rows, "sigma_n");
  EXPECT_EQ(sigma.num_trials, 12);
  EXPECT_EQ(sigma.num_objects, 6);
  EXPECT_NEAR(sigma.change, -0.2 + 0.001, 1e-9);  // the small terms are 1, 2, 0, 1, 2, 0
  ASSERT_TRUE(sigma.interval);
  EXPECT_LT(sigma.interval->low, sigma.change);
  EXPECT_GT(sigma.interval->high, sigma.change);
  EXPECT_NEAR(sigma.means.front(), 7.5, 1e-9);
  EXPECT_NEAR(sigma.means.back(), 7.5 - 0.6 + 0.003, 1e-9);
}

TEST(DelaySummary, WhatClosingDoesComesFromTheTraces) {
  EXPECT_NEAR(Find(SummariseDelays(MakeTrials()), "closing_shift_m").change, 0.001, 1e-12);
}

TEST(DelaySummary, ATouchBeforeClosureLeavesNoFormingTime) {
  std::vector<DelayedTrial> trials = MakeTrials();
  trials[0].record.result.timing.contact_before_start = true;
  EXPECT_EQ(Find(SummariseDelays(trials), "gft_s").num_trials, 11);
}

// A trial that fails at one delay would make the others look better or worse than they are.
TEST(DelaySummary, StabilityIsComparedAmongTrialsThatSucceedAtEveryDelay) {
  std::vector<DelayedTrial> trials = MakeTrials();
  ASSERT_EQ(trials[4].delay, 0.3);
  trials[4].record.result.outcome = Outcome::kPushedAway;
  const auto rows = SummariseDelays(trials);
  EXPECT_EQ(Find(rows, "sigma_n").num_trials, 11);
  EXPECT_EQ(Find(rows, "sigma_n").num_left_out, 1);
  const DoseResponse& success = Find(rows, "success");
  EXPECT_EQ(success.num_trials, 12);
  EXPECT_EQ(success.num_left_out, 0);
  EXPECT_NEAR(success.means.back(), 11.0 / 12.0, 1e-12);
}

TEST(DelaySummary, FewObjectsHaveNoIntervalAndSayWhy) {
  std::vector<DelayedTrial> trials = MakeTrials();
  trials.resize(4 * 2 * ListDelays().size());
  const auto rows = SummariseDelays(trials);
  EXPECT_FALSE(Find(rows, "sigma_n").interval);
  const Json json = MakeDosesJson({Find(rows, "sigma_n")})[0];
  EXPECT_TRUE(json.at("low").is_null());
  EXPECT_EQ(json.at("no_interval"), "4 to resample; an interval needs 5 or more");
}

}  // namespace
}  // namespace graspbench
