#include "workbench/experiments/numerics_check.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/units.h"
#include "datasets/plan/conditions.h"
#include "workbench/experiments/pool/session_worker.h"
#include "workbench/tables/numerics_tables.h"

namespace graspbench {
namespace {

TrialRecord MakeRecord(const std::string& object, int trial, Outcome outcome, double gct) {
  TrialRecord record;
  record.plan = {object + std::to_string(trial), "tum", object, "g1", trial};
  record.result.outcome = outcome;
  record.result.timing.gct = gct;
  record.result.timing.gft = record.result.timing.got = kUnset;
  record.result.stability.sigma = 2.0;
  return record;
}

NumericsComparison Compare(const TrialRecord& before, Outcome outcome, double gct) {
  NumericsComparison comparison{"half step", before, before.result};
  comparison.after.outcome = outcome;
  comparison.after.timing.gct = gct;
  return comparison;
}

TEST(NumericsCheck, VariantsChangeOneThingEach) {
  SessionConfig config;
  const std::vector<Condition> variants = ListNumericsVariants(config);
  ASSERT_EQ(variants.size(), 5u);
  const auto apply = [&](size_t i) { return ApplyCondition(variants[i], config).config.sim; };
  EXPECT_DOUBLE_EQ(apply(0).step, 0.5 * config.sim.step);
  EXPECT_DOUBLE_EQ(apply(0).contact_stiffness, config.sim.contact_stiffness);
  EXPECT_DOUBLE_EQ(apply(1).step, 2.0 * config.sim.step);
  EXPECT_DOUBLE_EQ(apply(2).contact_stiffness, 0.5 * config.sim.contact_stiffness);
  EXPECT_DOUBLE_EQ(apply(2).tangential_stiffness, 0.5 * config.sim.tangential_stiffness);
  EXPECT_DOUBLE_EQ(apply(2).step, config.sim.step);
  EXPECT_DOUBLE_EQ(apply(3).contact_stiffness, 2.0 * config.sim.contact_stiffness);
  EXPECT_TRUE(ApplyCondition(variants[4], config).is_compliant);
  // What a session must not have is left out: half of the shortest step.
  config.sim.step = 1e-4;
  EXPECT_EQ(ListNumericsVariants(config).size(), 4u);
}

TEST(NumericsCheck, AFlipChangesTheVerdictNotTheKindOfFailure) {
  const TrialRecord held = MakeRecord("cup", 0, Outcome::kSuccess, 0.5);
  const TrialRecord lost = MakeRecord("cup", 1, Outcome::kPushedAway, 0.5);
  EXPECT_FALSE(Compare(held, Outcome::kSuccess, 0.5).is_flipped());
  EXPECT_TRUE(Compare(held, Outcome::kNoContact, 0.5).is_flipped());
  EXPECT_FALSE(Compare(lost, Outcome::kNoContact, 0.5).is_flipped());
  EXPECT_TRUE(Compare(lost, Outcome::kSuccess, 0.5).is_flipped());
}

TEST(NumericsCheck, SummaryIsOfAbsoluteChangesThatExist) {
  const TrialRecord held = MakeRecord("cup", 0, Outcome::kSuccess, 0.5);
  const std::vector<NumericsComparison> comparisons = {
      Compare(held, Outcome::kSuccess, 0.49), Compare(held, Outcome::kSuccess, 0.53),
      Compare(held, Outcome::kNoContact, kUnset), Compare(held, Outcome::kSuccess, 0.5)};
  const NumericsSummary summary = SummariseNumerics("half step", comparisons);
  EXPECT_EQ(summary.num_trials, 4);
  EXPECT_EQ(summary.num_successes_before, 4);
  EXPECT_EQ(summary.num_successes, 3);
  EXPECT_EQ(summary.num_flips, 1);
  EXPECT_EQ(summary.gct.num, 3);
  EXPECT_NEAR(summary.gct.median, 0.01, 1e-12);
  EXPECT_NEAR(summary.gct.max, 0.03, 1e-12);
  EXPECT_EQ(summary.gft.num, 0);
  EXPECT_DOUBLE_EQ(summary.sigma.max, 0.0);
  EXPECT_EQ(SummariseNumerics("double step", comparisons).num_trials, 0);
}

// Fingertips that slide on the table must do so alike at every step; with static friction back at
// once they stuck, the sooner the shorter the steps, and never reached the pencil. The step is of
// first order: every halving halves what is left.
TEST(NumericsCheck, FingertipsDragOnTheTableAlikeAtEveryStep) {
  SessionConfig config;
  config.hands = {"shadow"};
  config.objects = {"pencil"};
  config.trials = 4;
  const SessionInputs inputs = LoadSessionInputs(config);
  const PlannedTrial planned = MakePlan(config, inputs).back();
  std::vector<double> last_contacts;
  for (const double step : {0.002, 0.001, 0.0005}) {
    config.sim.step = step;
    const TrialResult result = PlannedTrialRunner(config, inputs).Run(planned);
    EXPECT_EQ(result.outcome, Outcome::kSuccess) << "step " << step;
    last_contacts.push_back(result.timing.gct);
  }
  const double first = last_contacts[0] - last_contacts[1];
  const double second = last_contacts[1] - last_contacts[2];
  EXPECT_LT(std::abs(second), 0.75 * std::abs(first));
  const double limit = last_contacts[2] - second;
  EXPECT_NEAR(last_contacts[0], limit, 0.01 * limit);
}

TEST(NumericsCheck, CsvHasARowPerComparisonAndEmptyCellsForWhatIsMissing) {
  const TrialRecord held = MakeRecord("cup", 7, Outcome::kSuccess, 0.5);
  EXPECT_EQ(FormatNumericsCsv({Compare(held, Outcome::kNoContact, kUnset)}),
            "variant,trial_id,hand,object,grasp,trial,outcome_before,outcome,flipped,"
            "gct_s_before,gct_s,gft_s_before,gft_s,got_s_before,got_s,sigma_before,sigma,"
            "hold_creep_m,steady_penetration_m,unconverged_steps\n"
            "half step,cup7,tum,cup,g1,7,success,no contact,1,0.5,,,,,,2.0,2.0,,,0\n");
}

TEST(NumericsCheck, TablesListTheFlips) {
  const TrialRecord held = MakeRecord("cup", 7, Outcome::kSuccess, 0.5);
  const std::vector<NumericsComparison> same = {Compare(held, Outcome::kSuccess, 0.502)};
  EXPECT_EQ(FormatNumericsTables({SummariseNumerics("half step", same)}, same),
            "variant    trials  held before  held now  flips  GCT [ms]  max  GFT [ms]  max"
            "  GOT [ms]  max  sigma    max\n"
            "half step       1            1         1      0       2.0  2.0       n/a  n/a"
            "       n/a  n/a  0.000  0.000\n"
            "changes of GCT, GFT, GOT, sigma: median and largest\n"
            "\nno verdict flips\n");
  const std::vector<NumericsComparison> flipped = {Compare(held, Outcome::kNoContact, 0.5)};
  const std::string text = FormatNumericsTables({SummariseNumerics("half step", flipped)}, flipped);
  EXPECT_NE(text.find("half step  tum   cup     g1         7  success  no contact\n"),
            std::string::npos)
      << text;
}

}  // namespace
}  // namespace graspbench
