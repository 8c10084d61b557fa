#include <gtest/gtest.h>

#include <cmath>

#include "core/base/units.h"
#include "core/trial/trial_runner.h"
#include "datasets/analysis/conditions/numerics_summary.h"
#include "datasets/plan/conditions.h"
#include "datasets/plan/session_plan.h"

namespace graspbench {
namespace {

NumericsComparison MakeFlip() {
  NumericsComparison comparison;
  comparison.variant = "half step";
  TrialRecord& before = comparison.before;
  before.plan = {"cup7", "tum", "cup", "g1", 7};
  before.result.outcome = Outcome::kSuccess;
  before.result.timing = {0.5, kUnset, kUnset, kUnset, kUnset, false};
  before.result.stability.sigma = 2.0;
  comparison.after = before;
  comparison.after.result.outcome = Outcome::kNoContact;
  comparison.after.result.timing.gct = kUnset;
  return comparison;
}

TEST(NumericsVariants, VariantsChangeOneThingEach) {
  SessionConfig config;
  const std::vector<Condition> variants = ListNumericsVariants(config);
  ASSERT_EQ(variants.size(), 8u);
  const auto apply = [&](size_t i) { return ApplyCondition(variants[i], config).config.sim; };
  const double friction = ApplyCondition(variants[5], config).config.model.friction_scale;
  EXPECT_DOUBLE_EQ(apply(0).step, 0.25 * config.sim.step);
  EXPECT_DOUBLE_EQ(apply(0).contact_stiffness, config.sim.contact_stiffness);
  EXPECT_DOUBLE_EQ(apply(1).step, 0.5 * config.sim.step);
  EXPECT_DOUBLE_EQ(apply(2).step, 2.0 * config.sim.step);
  EXPECT_DOUBLE_EQ(apply(3).contact_stiffness, 0.5 * config.sim.contact_stiffness);
  EXPECT_DOUBLE_EQ(apply(3).tangential_stiffness, 0.5 * config.sim.tangential_stiffness);
  EXPECT_DOUBLE_EQ(apply(3).step, config.sim.step);
  EXPECT_DOUBLE_EQ(apply(4).contact_stiffness, 2.0 * config.sim.contact_stiffness);
  EXPECT_NEAR(std::abs(friction / config.model.friction_scale - 1.0), 0.001, 1e-12);
  EXPECT_TRUE(ApplyCondition(variants.back(), config).is_compliant);
  SessionConfig carried = config;
  carried.arm.model = "pa10";
  EXPECT_EQ(ListNumericsVariants(carried).size(), 7u) << "the compliant backend has no arm";
  // What a session must not have is left out: a half and a quarter of the shortest step.
  config.sim.step = 1e-4;
  EXPECT_EQ(ListNumericsVariants(config).size(), 6u);
}

// Fingertips that slide on the table must do so alike at every step; with static friction back at
// once they stuck, the sooner the shorter the steps, and never reached the pencil. The step is of
// first order: every halving halves what is left.
TEST(NumericsVariants, FingertipsDragOnTheTableAlikeAtEveryStep) {
  SessionConfig config;
  config.hands = {"shadow-evolved"};
  config.objects = {"pencil"};
  config.trials = 4;
  const SessionInputs inputs = LoadSessionInputs(config);
  const PlannedTrial planned = MakePlan(config, inputs).back();
  std::vector<double> last_contacts;
  for (const double step : {0.002, 0.001, 0.0005}) {
    config.sim.step = step;
    const TrialSetup setup = MakeTrialSetup(config, inputs, planned);
    const TrialResult result = TrialRunner(setup.hand, setup.object).Run(setup);
    EXPECT_EQ(result.outcome, Outcome::kSuccess) << "step " << step;
    last_contacts.push_back(result.timing.gct);
  }
  const double first = last_contacts[0] - last_contacts[1];
  const double second = last_contacts[1] - last_contacts[2];
  EXPECT_LT(std::abs(second), 0.75 * std::abs(first));
  const double limit = last_contacts[2] - second;
  EXPECT_NEAR(last_contacts[0], limit, 0.01 * limit);
}

TEST(NumericsVariants, CsvHasARowPerComparisonAndEmptyCellsForWhatIsMissing) {
  EXPECT_EQ(FormatNumericsCsv({MakeFlip()}),
            "variant,trial_id,hand,object,grasp,trial,outcome_before,outcome,flipped,seat_before,"
            "seat,flagged,gct_s_before,gct_s,gft_s_before,gft_s,got_s_before,got_s,sigma_before,"
            "sigma,grip_n_before,grip_n,breaking_force_n_before,breaking_force_n,hold_creep_m,"
            "steady_penetration_m,unconverged_steps\n"
            "half step,cup7,tum,cup,g1,7,success,no contact,1,,,0,0.5,,,,,,2.0,2.0,,,,,,,0\n");
}

}  // namespace
}  // namespace graspbench
