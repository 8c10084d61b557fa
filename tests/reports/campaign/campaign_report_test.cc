#include "reports/campaign/campaign_report.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "reports/campaign/campaign_section.h"
#include "tests/reports/report_fixture.h"

namespace graspbench {
namespace {

/** Two scenes of ten trials. Sigma is 1, 2, 3 for the three variants, plus 0.01 per trial; GFT% is
40, 20, 10 %; on the can the new target grasp fails in six trials. */
Campaign MakeCampaign() {
  Campaign campaign;
  campaign.config.session.trials = 10;
  for (const char* object : {"can", "cup"}) {
    SceneRecord scene;
    scene.config.hand = "tum";
    scene.config.object = object;
    scene.config.grasp = "g3";
    scene.result = {
        {"pregrasp_step",
         {{"verdict", "taken: <it> closes better"},
          {"taken", "one-shot, half"},
          {"standard", {{"gft_ratio_without_variation", 0.2}}},
          {"shots",
           {{{"name", "one-shot, widest"}, {"score", {{"gft_ratio_without_variation", 0.01}}}},
            {{"name", "one-shot, half"}, {"score", {{"gft_ratio_without_variation", 0.05}}}}}}}},
        {"target_step",
         {{"verdict", "taken"},
          {"joints", {"THJ1"}},
          {"start_rad", {0.5}},
          {"found_rad", {0.25}},
          {"lower_rad", {0.1}},
          {"upper_rad", {0.9}}}}};
    campaign.scenes.push_back(scene);
    int variant = 0;
    for (const char* grasp : {"g3", "new-pregrasp", "new-target"}) {
      for (int trial = 0; trial < 10; ++trial) {
        const PlannedTrial plan = {std::string(grasp) + object + std::to_string(trial), "tum",
                                   object, grasp, trial};
        const bool fails = variant == 2 && std::string(object) == "can" && trial < 6;
        TrialRecord record =
            MakeRecord(plan, fails ? Outcome::kSlippedInLiftOff : Outcome::kSuccess);
        record.result.stability.sigma = 1.0 + variant + 0.01 * trial;
        record.result.timing.gft_ratio = 0.4 / (1 << variant) + 0.001 * trial;
        campaign.benchmark.plan.push_back(plan);
        campaign.benchmark.records.push_back(record);
      }
      ++variant;
    }
  }
  for (const char* method : {"es", "random"}) {
    for (int seed = 1; seed <= 3; ++seed) {
      ComparisonRun run = {"tum", "can", method, seed, {0.0, 1.0, 2.0, 2.0}, 3};
      if (std::string(method) == "random") run.fitness = {0.0, 0.5, 0.5, 1.0};
      if (std::string(method) == "random") run.evaluations_to_90 = 0;
      campaign.comparison.push_back(run);
    }
  }
  return campaign;
}

struct Summarised {
  explicit Summarised(Campaign the_campaign)
      : campaign(std::move(the_campaign)),
        benchmark(SummariseSession(campaign.benchmark)),
        scenes(ListScenes(campaign, benchmark)) {}
  Campaign campaign;
  SessionSummary benchmark;
  std::vector<SceneVariants> scenes;
};

TEST(CampaignSummary, StepsAreRatiosOfMediansOverScenes) {
  const Summarised summarised(MakeCampaign());
  const StepEffect gft =
      CalcStepEffect(FindVariantMeasure("GFT%"), summarised.scenes, kStandardGrasp, kNewPreGrasp);
  EXPECT_EQ(gft.num_scenes, 2);
  EXPECT_NEAR(gft.median_before, 0.4045, 1e-12);
  EXPECT_NEAR(gft.median_after, 0.2045, 1e-12);
  EXPECT_TRUE(gft.worse.empty());
  EXPECT_EQ(gft.ratio.reason(), "2 to draw from; expected 5 or more");
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

TEST(CampaignSummary, FourOfTenAfterTenOfTenIsSignificant) {
  // Fisher, two-sided: 10/10 against 4/10 has p = 0.011.
  const Summarised summarised(MakeCampaign());
  const auto lower = ListSignificantlyLower(summarised.scenes, kNewPreGrasp, kNewTarget);
  ASSERT_EQ(lower.size(), 1U);
  EXPECT_EQ(lower[0]->object, "can");
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

TEST(CampaignReport, ThePageIsSoundAndTellsWhatIsWorse) {
  const Summarised summarised(MakeCampaign());
  const SessionModels models;
  const VariantPictures pictures;
  const std::string page = MakeCampaignReport(
      {summarised.campaign, summarised.benchmark, summarised.scenes, models, pictures});
  ExpectSoundPage(page);
  tinyxml2::XMLDocument document;
  ParsePage(page, document);
  const std::string text = ListText(*document.RootElement());
  for (const char* part :
       {"tum, can (10 of 10 before, 4 of 10 after)", "above random search in 1 of 1 scene",
        "Step 1: taken: <it> closes better", "THJ1", "28.6", "-14.3",
        "brings the median GFT% from 20.0\u00a0% to 5.0\u00a0% (2 scenes",
        "Two hands are compared; this campaign has 1 hand."}) {
    EXPECT_NE(text.find(part), std::string::npos) << part;
  }
}

// The second hand repeats the first one with sigma one higher.
TEST(CampaignReport, TheHandsAreComparedOnTheSameObjects) {
  Campaign campaign = MakeCampaign();
  const std::vector<SceneRecord> scenes = campaign.scenes;
  for (SceneRecord scene : scenes) {
    scene.config.hand = "shadow";
    campaign.scenes.push_back(scene);
  }
  const std::vector<TrialRecord> records = campaign.benchmark.records;
  for (TrialRecord record : records) {
    record.plan.hand = "shadow";
    record.plan.id += "s";
    record.result.stability.sigma += 1.0;
    campaign.benchmark.plan.push_back(record.plan);
    campaign.benchmark.records.push_back(record);
  }
  const Summarised summarised(campaign);
  const SessionModels models;
  const VariantPictures pictures;
  const std::string page = MakeCampaignReport(
      {summarised.campaign, summarised.benchmark, summarised.scenes, models, pictures});
  tinyxml2::XMLDocument document;
  ParsePage(page, document);
  std::string text = ListText(*document.RootElement());
  std::replace(text.begin(), text.end(), '\n', ' ');
  EXPECT_NE(text.find("sigma standard grasp 2 1.04 2.04 0 2"), std::string::npos);
}

TEST(CampaignReport, NothingFinishedIsAPage) {
  Campaign campaign = MakeCampaign();
  campaign.benchmark = Session();
  campaign.comparison.clear();
  for (SceneRecord& scene : campaign.scenes) scene.result = Json();
  const Summarised summarised(campaign);
  const SessionModels models;
  const VariantPictures pictures;
  const std::string page = MakeCampaignReport(
      {summarised.campaign, summarised.benchmark, summarised.scenes, models, pictures});
  ExpectSoundPage(page);
  EXPECT_NE(page.find("not finished"), std::string::npos);
}

}  // namespace
}  // namespace graspbench
