#include "reports/campaign/campaign_report.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "reports/campaign/campaign_section.h"
#include "tests/reports/report_fixture.h"

namespace graspbench {
namespace {

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
  ExpectParts(text,
              {"success is significantly lower in 0 scenes", "above random search in 1 of 1 scene",
               "Step 1: taken: <it> closes better", "THJ1", "28.6", "-14.3",
               "step 1 changes the median GFT% from 20.0\u00a0% to 5.0\u00a0% (2 scenes",
               "tum: headroom not known: 2 scenes without a figure (no headroom is recorded)",
               "Two hands are compared; this campaign has 1 hand."});
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
  ExpectParts(text, {"sigma [N] standard grasp 2 1.04 2.04 0 2"});
}

// Of one scene there is no interval over scenes; the change is drawn all the same.
TEST(CampaignReport, OneSceneHasAFigureToo) {
  Campaign campaign = MakeCampaign();
  campaign.scenes.resize(1);
  campaign.config.session.trials = 7;
  const Summarised summarised(campaign);
  ASSERT_EQ(CountComplete(summarised.scenes), 1);
  const SessionModels models;
  const VariantPictures pictures;
  const std::string page = MakeCampaignReport(
      {summarised.campaign, summarised.benchmark, summarised.scenes, models, pictures});
  tinyxml2::XMLDocument document;
  ParsePage(page, document);
  const std::string summary = ListText(*FindById(*document.RootElement(), "summary"));
  ExpectParts(summary, {"1 scene, no interval"});
  ExpectParts(page, {"graspbench campaign --set &#39;session.trials=7&#39; --out ANOTHER"});
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
  ExpectParts(page, {"not finished"});
}

}  // namespace
}  // namespace graspbench
