#include "datasets/analysis/campaign/real_comparison.h"

#include <gtest/gtest.h>

#include "tests/datasets/analysis/made_results.h"

namespace graspbench {
namespace {

/** Two scenes; in the simulation GFT% falls from 40 to 20 % in both, and all trials succeed. */
Campaign MakeTwoScenes() {
  Campaign campaign;
  for (const std::string object : {"can", "cup"}) {
    SceneRecord scene;
    scene.config.hand = "tum";
    scene.config.object = object;
    scene.config.grasp = "g3";
    scene.result = {{"target_step", {{"taken", true}}}};
    campaign.scenes.push_back(scene);
    const char* grasps[] = {"g3", "new-pregrasp", "new-target"};
    for (int variant = 0; variant < 3; ++variant) {
      for (int trial = 0; trial < 4; ++trial) {
        const PlannedTrial plan = {object + grasps[variant] + std::to_string(trial), "tum", object,
                                   grasps[variant], trial};
        TrialRecord record = MakeRecord(plan, Outcome::kSuccess);
        record.result.contacts = {{"TH", true, 0.5}, {"FF", false, 0.4}};
        record.result.timing.gft_ratio = variant == 0 ? 0.4 : 0.2;
        campaign.benchmark.plan.push_back(plan);
        campaign.benchmark.records.push_back(record);
      }
    }
  }
  return campaign;
}

RealTrial MakeReal(const std::string& object, Variant variant, int trial, bool is_success,
                   double thumb, double index) {
  RealTrial real;
  real.hand = "tum";
  real.object = object;
  real.variant = variant;
  real.trial = trial;
  real.is_success = is_success;
  real.contacts = {{"MF", false, 9.0}, {"FF", false, index}, {"TH", false, thumb}};
  return real;
}

// Counted by hand: the can's GFT% falls really, too, from (0.5 - 0.4) / 0.5 to 0.1; the cup's rises.
TEST(CompareWithReal, CountsByHand) {
  const Summarised simulated(MakeTwoScenes());
  std::vector<RealTrial> real;
  for (int trial = 0; trial < 3; ++trial) {
    real.push_back(MakeReal("can", kStandardGrasp, trial, trial > 0, 0.5, 0.4));
    real.push_back(MakeReal("can", kNewPreGrasp, trial, true, 0.5, 0.45));
    real.push_back(MakeReal("cup", kStandardGrasp, trial, true, 0.5, 0.4));
    real.push_back(MakeReal("cup", kNewPreGrasp, trial, true, 0.5, 0.2));
  }
  real.push_back(MakeReal("pen", kStandardGrasp, 0, true, 0.5, 0.4));
  real.back().is_made_up = true;
  const RealComparison found = CompareWithReal(real, simulated.scenes);
  EXPECT_EQ(found.num_made_up, 1);
  EXPECT_EQ(found.num_unmatched, 1);
  ASSERT_EQ(found.cells.size(), 4u);
  EXPECT_EQ(found.cells[0].real.successes(), 2);
  EXPECT_EQ(found.cells[0].real.finished, 3);
  EXPECT_NEAR(found.cells[0].median_gft_ratio(), 0.2, 1e-12);  // the middle finger is not asked
  EXPECT_NEAR(found.cells[0].success_p, 3.0 / 7.0, 1e-12);     // 1 loss of 7 among the 3
  EXPECT_TRUE(found.totals.empty());                           // the third variant was not tried
  real.push_back(MakeReal("can", kNewTarget, 0, true, 0.5, -0.4));
  const RealComparison more = CompareWithReal(real, simulated.scenes);
  ASSERT_EQ(more.totals.size(), 3u);  // of the can alone
  EXPECT_EQ(more.totals[0].real.successes(), 2);
  EXPECT_EQ(more.totals[0].simulated.finished, 4);
  EXPECT_TRUE(more.cells[2].gft_ratios.empty());  // touched before the start of closure
  for (const RealAgreement& agreement : found.agreements) {
    const bool is_gft_of_step_1 =
        agreement.step == std::string("step 1") && agreement.measure == std::string("GFT%");
    EXPECT_EQ(agreement.num_scenes, is_gft_of_step_1 ? 2 : 0) << agreement.step;
    EXPECT_EQ(agreement.num_alike, is_gft_of_step_1 ? 1 : 0) << agreement.step;
  }
}

TEST(CompareWithReal, MissingContactsHaveNoGft) {
  const Summarised simulated(MakeTwoScenes());
  RealTrial untimed = MakeReal("can", kStandardGrasp, 0, true, 0.5, 0.4);
  untimed.contacts.clear();
  const RealTrial untouched =
      MakeReal("can", kStandardGrasp, 1, true, std::numeric_limits<double>::quiet_NaN(), 0.4);
  const RealComparison found = CompareWithReal({untimed, untouched}, simulated.scenes);
  ASSERT_EQ(found.cells.size(), 1u);
  EXPECT_TRUE(found.cells[0].gft_ratios.empty());
  EXPECT_EQ(found.cells[0].real.finished, 2);
}

}  // namespace
}  // namespace graspbench
