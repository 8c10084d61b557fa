#include "datasets/analysis/conditions/numerics_summary.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/units.h"

namespace graspbench {
namespace {

TrialRecord MakeHeld(double grip, double sigma, double rise = 0.001) {
  TrialRecord record;
  record.result.outcome = Outcome::kSuccess;
  record.result.timing = {0.5, 0.2, kUnset, kUnset, kUnset, false};
  record.result.weight = 0.5;
  record.result.object_height = 0.04;
  record.result.closure_rise = rise;
  record.result.closure_slide = 0.01;
  record.result.stability.hold.normal_force = grip;
  record.result.stability.sigma = sigma;
  return record;
}

TrialRecord MakeLost(Outcome outcome) {
  TrialRecord record;
  record.result.outcome = outcome;
  return record;
}

NumericsComparison Compare(const TrialRecord& before, const TrialRecord& after) {
  return {"half step", before, after};
}

TEST(NumericsSummary, AFlipChangesTheVerdictNotTheKindOfFailure) {
  const TrialRecord held = MakeHeld(10.0, 1.0);
  const TrialRecord pushed = MakeLost(Outcome::kPushedAway), missed = MakeLost(Outcome::kNoContact);
  EXPECT_FALSE(Compare(held, held).is_flipped());
  EXPECT_TRUE(Compare(held, missed).is_flipped());
  EXPECT_FALSE(Compare(pushed, missed).is_flipped());
  EXPECT_TRUE(Compare(pushed, held).is_flipped());
}

TEST(NumericsSummary, ChangesAreRelativeAndOfOneSeat) {
  const TrialRecord kept = MakeHeld(10.0, 1.0), reseated = MakeHeld(4.0, 0.5, 0.03);
  const std::vector<NumericsSummary> summaries = SummariseNumerics(
      {Compare(kept, MakeHeld(10.1, 1.02)), Compare(kept, MakeHeld(9.7, 1.0)),
       Compare(kept, reseated), Compare(reseated, MakeHeld(2.0, 0.5, 0.03)),
       Compare(kept, MakeLost(Outcome::kNoContact)), Compare(kept, MakeHeld(10.0, 1.2))});
  ASSERT_EQ(summaries.size(), 1u);
  const NumericsSummary& summary = summaries[0];
  EXPECT_EQ(summary.num_trials, 6);
  EXPECT_EQ(summary.num_successes_before, 6);
  EXPECT_EQ(summary.num_successes, 5);
  EXPECT_EQ(summary.num_flips, 1);
  EXPECT_EQ(summary.num_held, 5);
  EXPECT_EQ(summary.num_seat_flips, 1);
  EXPECT_EQ(summary.num_flagged, 1) << "the reseated one may change";
  EXPECT_EQ(summary.num_large, 2) << "one whose seat flips, one whose sigma changes by 20 %";
  ASSERT_EQ(summary.seats.size(), 2u);
  EXPECT_EQ(summary.seats[0].num_held, 3);
  const ChangeSummary& grip = summary.seats[0].changes[4];
  EXPECT_EQ(grip.num, 3);
  EXPECT_NEAR(grip.median, 0.01, 1e-12);
  EXPECT_NEAR(grip.max, 0.03, 1e-12);
  EXPECT_EQ(summary.seats[0].changes[2].num, 0) << "no GOT";
  EXPECT_TRUE(std::isnan(summary.seats[0].changes[5].median)) << "nothing is judged";
  EXPECT_EQ(summary.seats[1].seat, Seat::kReseated);
  EXPECT_NEAR(summary.seats[1].changes[4].max, 0.5, 1e-12);
}

TEST(NumericsSummary, AVariantCountsWhatOnlyOthersHave) {
  std::vector<NumericsComparison> comparisons(3, Compare(MakeHeld(10.0, 1.0), MakeHeld(10.0, 1.0)));
  comparisons[1].before.plan.id = comparisons[1].after.plan.id = "other";
  comparisons[2].variant = "compliant";
  const std::vector<NumericsSummary> summaries = SummariseNumerics(comparisons);
  ASSERT_EQ(summaries.size(), 2u);
  EXPECT_EQ(summaries[0].num_left_out, 0);
  EXPECT_EQ(summaries[1].num_left_out, 1);
}

TEST(NumericsSummary, ASessionInNoFolderWasNotChecked) {
  EXPECT_TRUE(LoadNumericsComparisons(Session()).empty());
  EXPECT_TRUE(SummariseNumerics(std::vector<NumericsComparison>()).empty());
}

}  // namespace
}  // namespace graspbench
