#include "datasets/analysis/campaign/campaign_summary.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/files/files.h"
#include "tests/datasets/analysis/made_results.h"
#include "tests/datasets/session/fake_session.h"

namespace graspbench {

namespace {

TEST(CampaignSummary, StepsAreRatiosOfMediansOverScenes) {
  const Summarised summarised(MakeCampaign());
  const StepEffect gft =
      CalcStepEffect(FindVariantMeasure("GFT%"), summarised.scenes, kStandardGrasp, kNewPreGrasp);
  EXPECT_EQ(gft.num_scenes, 2);
  EXPECT_NEAR(gft.median_before, 0.4045, 1e-12);
  EXPECT_NEAR(gft.median_after, 0.2045, 1e-12);
  EXPECT_TRUE(gft.worse.empty());
  EXPECT_EQ(gft.ratio.reason(), "2 to resample; an interval needs 5 or more");
  const StepEffect success =
      CalcStepEffect(FindVariantMeasure("success"), summarised.scenes, kNewPreGrasp, kNewTarget);
  ASSERT_EQ(success.worse.size(), 1U);
  EXPECT_EQ(success.worse[0]->object, "can");
}

TEST(CampaignSummary, TrialsOfOnePoseArePairs) {
  const Summarised summarised(MakeCampaign());
  const std::vector<double> differences = ListPairedDifferences(
      FindVariantMeasure("sigma"), summarised.scenes[1], kStandardGrasp, kNewTarget);
  ASSERT_EQ(differences.size(), 10U);
  for (double difference : differences) EXPECT_NEAR(difference, 2.0, 1e-12);
}

// A grasp that was kept comes from a file with rounded angles the second time.
TEST(CampaignSummary, TheRoundingOfAGraspsFileIsNoDifference) {
  Campaign campaign = MakeCampaign();
  for (TrialRecord& record : campaign.benchmark.records) {
    record.result.stability.sigma =
        record.plan.grasp == campaign.benchmark.records[0].plan.grasp ? 2.0 : 2.0 - 1e-8;
  }
  const Summarised summarised(campaign);
  const StepEffect effect =
      CalcStepEffect(FindVariantMeasure("sigma"), summarised.scenes, kStandardGrasp, kNewTarget);
  EXPECT_EQ(effect.num_scenes, 2);
  EXPECT_TRUE(effect.worse.empty());
  EXPECT_EQ(effect.plain_ratio(), 1.0);
  for (const double difference : ListPairedDifferences(
           FindVariantMeasure("sigma"), summarised.scenes[0], kStandardGrasp, kNewTarget)) {
    EXPECT_EQ(difference, 0.0);
  }
}

// McNemar, exact: of ten pairs six lost and none gained has p = 2 / 2^6, of two scenes twice that;
// nine lost has 4 / 2^9.
TEST(CampaignSummary, LostPairsAreSignificantAfterHolm) {
  Campaign campaign = MakeCampaign();
  EXPECT_TRUE(
      ListSignificantlyLower(Summarised(campaign).scenes, kNewPreGrasp, kNewTarget).empty());
  int num_lost = 0;
  for (TrialRecord& record : campaign.benchmark.records) {
    if (record.plan.object == "can" && record.plan.grasp == "new-target" && num_lost < 9) {
      record.result.outcome = Outcome::kSlippedInLiftOff;
      ++num_lost;
    }
  }
  const Summarised summarised(campaign);
  const auto lower = ListSignificantlyLower(summarised.scenes, kNewPreGrasp, kNewTarget);
  ASSERT_EQ(lower.size(), 1U);
  EXPECT_EQ(lower[0].scene->object, "can");
  EXPECT_NEAR(lower[0].p_holm, 4.0 / 512.0, 1e-12);
  EXPECT_TRUE(ListSignificantlyLower(summarised.scenes, kStandardGrasp, kNewPreGrasp).empty());
}

TEST(CampaignSummary, CurvesAreTheBestSoFar) {
  const std::vector<MethodCurve> curves = ListMethodCurves(MakeCampaign());
  ASSERT_EQ(curves.size(), 2U);
  EXPECT_EQ(curves[0].median, (std::vector<double>{0.0, 1.0, 2.0, 2.0}));
  EXPECT_EQ(curves[1].median, (std::vector<double>{0.0, 0.5, 0.5, 1.0}));
  EXPECT_EQ(curves[0].median_evaluations_to_90, 3.0);
  EXPECT_TRUE(std::isnan(curves[1].median_evaluations_to_90));
}

TEST(CampaignSummary, WithoutVariationTheMedianIsOverTheScenes) {
  Campaign campaign = MakeCampaign();
  campaign.scenes[1].result["pregrasp_step"]["standard"]["gft_ratio_without_variation"] = 0.4;
  const Summarised summarised(campaign);
  const GftWithoutVariation gft = CalcGftWithoutVariation(summarised.scenes);
  EXPECT_EQ(gft.num_scenes, 2);
  EXPECT_NEAR(gft.median_before, 0.3, 1e-12);
  EXPECT_NEAR(gft.median_after, 0.05, 1e-12);
  campaign.scenes[0].result.erase("pregrasp_step");
  EXPECT_EQ(CalcGftWithoutVariation(Summarised(campaign).scenes).num_scenes, 1);
}

// The second hand repeats the first one's can with sigma one higher and has no cup.
TEST(CampaignSummary, HandsAreComparedOnWhatBothGrasped) {
  Campaign campaign = MakeCampaign();
  campaign.scenes.push_back(campaign.scenes[0]);
  campaign.scenes.back().config.hand = "shadow";
  const std::vector<TrialRecord> records = campaign.benchmark.records;
  for (TrialRecord record : records) {
    if (record.plan.object != "can") continue;
    record.plan.hand = "shadow";
    record.plan.id += "s";
    record.result.stability.sigma += 1.0;
    campaign.benchmark.plan.push_back(record.plan);
    campaign.benchmark.records.push_back(record);
  }
  const Summarised summarised(campaign);
  const HandComparison sigma =
      CompareHands(FindVariantMeasure("sigma"), summarised.scenes, kStandardGrasp, "tum", "shadow");
  EXPECT_EQ(sigma.num_objects, 1);
  EXPECT_NEAR(sigma.median_a, 1.045, 1e-12);
  EXPECT_NEAR(sigma.median_b, 2.045, 1e-12);
  EXPECT_EQ(sigma.num_a_better, 0);
  EXPECT_EQ(sigma.num_b_better, 1);
}

/** Two trials of each variant of one scene. */
Campaign MakeBenchmark() {
  Campaign campaign;
  Session& session = campaign.benchmark;
  for (const char* grasp : {"g2", "new-pregrasp", "new-target"}) {
    for (int trial = 0; trial < 2; ++trial) {
      TrialRecord record;
      record.plan = {"id", "tum", "mug", grasp, trial};
      record.result.outcome = trial == 0 ? Outcome::kSuccess : Outcome::kPushedAway;
      record.result.stability.sigma = trial == 0 ? 3.0 : kUnset;
      record.result.contacts = {{"TH", true, 0.25}, {"FF", false, trial == 0 ? 0.5 : kUnset}};
      record.result.timing = CalcContactTiming(record.result.contacts, 0.0);
      session.records.push_back(record);
    }
  }
  SceneRecord scene;
  scene.config.hand = "tum";
  scene.config.object = "mug";
  scene.result = {{"target_step",
                   {{"taken", true},
                    {"headroom_before", {{"bound_n", 4.0}, {"share", 0.5}}},
                    {"headroom_after", {{"bound_n", 4.0}, {"share", 0.75}}}}}};
  campaign.scenes = {scene};
  return campaign;
}

TEST(SummariseVariants, HasOneRowForEachSceneAndVariant) {
  const auto rows = SummariseVariants(MakeBenchmark());
  ASSERT_EQ(rows.size(), 3u);
  EXPECT_EQ(rows[0].variant, kStandardGrasp);
  EXPECT_EQ(rows[0].grasp, "g2");
  EXPECT_EQ(rows[2].variant, kNewTarget);
  EXPECT_EQ(rows[1].trials, 2);
  EXPECT_EQ(rows[1].successes, 1);
  EXPECT_EQ(rows[1].mean_sigma, 1.5);
  EXPECT_TRUE(std::isnan(rows[1].median_gft_ratio));  // a digit did not touch in one of two
  EXPECT_NEAR(rows[1].median_gct, 0.5, 1e-12);
}

TEST(ExportCampaign, WritesALineForEachVariantAndSearch) {
  const TemporaryFolder folder;
  Campaign campaign = MakeBenchmark();
  campaign.comparison = {{"tum", "mug", "es", 1, {1.0, 1.5, 2.0}, 3},
                         {"tum", "mug", "es", 2, {1.0, 1.25}, 0}};
  CreateCampaign(folder.path(), CampaignConfig());
  ExportCampaign(folder.path(), campaign);
  EXPECT_EQ(ReadFile(folder.path() / "summary.csv"),
            "hand,object,grasp,variant,trials,successes,mean_sigma,median_gft_ratio,"
            "gft_ratio_floor,median_got_ratio,median_gft_s,median_got_s,median_gct_s,mean_breaking_"
            "force_n,median_grip_n,"
            "median_sigma_per_grip,median_breaking_per_grip,headroom_share\n"
            "tum,mug,g2,standard,2,1,1.5,,,,0.25,0.25,0.5,0.0,,,,\n"
            "tum,mug,new-pregrasp,new-pregrasp,2,1,1.5,,,,0.25,0.25,0.5,0.0,,,,0.5\n"
            "tum,mug,new-target,new-target,2,1,1.5,,,,0.25,0.25,0.5,0.0,,,,0.75\n");
  EXPECT_EQ(ReadFile(folder.path() / "comparison.csv"),
            "hand,object,method,seed,evaluations,start_fitness,best_fitness,evaluations_to_90\n"
            "tum,mug,es,1,3,1.0,2.0,3\n"
            "tum,mug,es,2,2,1.0,1.25,\n");
  EXPECT_TRUE(CheckStore(folder.path()).damages.empty());
  WriteFile(folder.path() / "summary.csv", "hand,object\n");
  const std::vector<Damage> damages = CheckStore(folder.path()).damages;
  ASSERT_EQ(damages.size(), 1u);
  EXPECT_EQ(damages[0].path, "summary.csv");
  RepairStore(folder.path());
  ExportCampaign(folder.path(), campaign);  // as when the campaign is continued
  EXPECT_TRUE(CheckStore(folder.path()).damages.empty());
  EXPECT_NE(ReadFile(folder.path() / "summary.csv").find("new-target"), std::string::npos);
}

}  // namespace

}  // namespace graspbench
