#include "datasets/analysis/campaign/headrooms.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/optimise/grasp_optimiser.h"
#include "tests/datasets/analysis/made_results.h"

namespace graspbench {

namespace {

/** A scene of which step 2 recorded these shares of 2 N and 2.5 N. */
SceneRecord MakeScene(const std::string& hand, double start, double after, bool is_taken) {
  SceneRecord scene;
  scene.config.hand = hand;
  scene.result = {{"target_step",
                   {{"taken", is_taken},
                    {"headroom_before", {{"bound_n", 2.0}, {"share", start}}},
                    {"headroom_after", {{"bound_n", 2.5}, {"share", after}}}}}};
  return scene;
}

TEST(Headrooms, OfAKeptStartIsTheStarts) {
  const Answer<SceneHeadroom> kept = FindHeadroom(MakeScene("tum", 0.6, 0.9, false));
  ASSERT_TRUE(kept) << kept.reason();
  EXPECT_EQ(kept->kept_share, 0.6);
  EXPECT_EQ(kept->kept_bound, 2.0);
  const Answer<SceneHeadroom> taken = FindHeadroom(MakeScene("tum", 0.6, 0.9, true));
  ASSERT_TRUE(taken) << taken.reason();
  EXPECT_EQ(taken->start_share, 0.6);
  EXPECT_EQ(taken->kept_share, 0.9);
  EXPECT_EQ(taken->kept_bound, 2.5);
}

// TUM: starts 0.5, 0.8, 1.6: median 0.8, 1 / 0.8 = 1.25; kept 0.75, 0.8, 1.6. Shadow reaches
// beneath.
TEST(Headrooms, MediansAreOfEachHandsScenes) {
  Campaign campaign;
  campaign.scenes = {MakeScene("tum", 0.5, 0.75, true), MakeScene("tum", 0.8, 0.9, false),
                     MakeScene("shadow", 1.1, 1.2, true), MakeScene("tum", 1.6, 0.1, false)};
  const std::vector<Headrooms> hands = ListHeadrooms(campaign);
  ASSERT_EQ(hands.size(), 2u);
  EXPECT_EQ(hands[0].hand, "tum");
  EXPECT_EQ(hands[0].num_scenes, 3);
  EXPECT_EQ(hands[0].median_start, 0.8);
  EXPECT_EQ(hands[0].median_kept, 0.8);
  EXPECT_EQ(DescribeHeadrooms(hands[0]),
            "step 2 starts from grasps that resist 0.80 of the load that friction and grip allow "
            "at an object's sides, and accepts grasps that resist 0.80 (medians of 3 scenes): at "
            "equal grip no side grasp is more than 1.25 times as strong as the median start; a "
            "grasp that reaches beneath the object may be");
  EXPECT_EQ(hands[1].num_scenes, 1);
  const std::string text = DescribeHeadrooms(hands[1]);
  EXPECT_NE(text.find("(medians of 1 scene): the median start is as strong as any"),
            std::string::npos)
      << text;
}

TEST(Headrooms, WhereNothingIsKnownTheReasonStandsThere) {
  Campaign campaign;
  SceneRecord scene;
  scene.config.hand = "tum";
  campaign.scenes.push_back(scene);
  EXPECT_EQ(FindHeadroom(scene).reason(), "the scene is not finished");
  scene.result = {{"pregrasp_step", {}}};
  campaign.scenes.push_back(scene);
  EXPECT_EQ(FindHeadroom(scene).reason(), "step 2 was not run");
  scene.result = {{"target_step", {{"taken", false}}}};
  EXPECT_EQ(FindHeadroom(scene).reason(), "no headroom is recorded");
  Json& step = scene.result["target_step"];
  step["headroom_before"] = {{"bound_n", nullptr}, {"share", nullptr}};
  campaign.scenes.push_back(scene);
  EXPECT_EQ(FindHeadroom(scene).reason(), "the start held nothing");
  step["headroom_before"] = {{"bound_n", 0.0}, {"share", nullptr}};
  EXPECT_EQ(FindHeadroom(scene).reason(), "friction and grip do not bear the weight");
  EXPECT_EQ(DescribeHeadrooms(ListHeadrooms(campaign).at(0)),
            "headroom not known: 3 scenes without a figure (step 2 was not run; the scene is not "
            "finished; the start held nothing)");
}

/** Sets the contacts of a scene's trials of one variant; its times are 1 .. 5 twice and 11. */
void SetContacts(const std::string& object, const std::string& grasp, double late,
                 Campaign& campaign) {
  for (TrialRecord& record : campaign.benchmark.records) {
    if (record.plan.object != object || record.plan.grasp != grasp) continue;
    const double thumb = 1.0 + record.plan.trial % 5;
    record.result.contacts = {{"TH", true, thumb}, {"FF", false, thumb + late}};
    if (late == 0.0) record.result.contacts[1].time = 11.0;
    record.result.timing = CalcContactTiming(record.result.contacts, 0.0);
  }
}

// As in the test of the floor by hand: 1 / 11. GFT% is 8 / 11 there (10, 9, 8, 7 and 6 of 11).
TEST(GftFloors, CountsScenesNearTheirFloor) {
  Campaign campaign = MakeCampaign();
  SetContacts("can", "new-pregrasp", 0.0, campaign);
  SetContacts("cup", "new-pregrasp", 2.0, campaign);  // always so late: floor 0
  {
    const Summarised summarised(campaign);
    const GftFloors floors = CalcGftFloors(summarised.scenes, kNewPreGrasp);
    EXPECT_EQ(floors.num_scenes, 2);
    EXPECT_EQ(floors.num_near, 0);
    EXPECT_EQ(floors.num_without, 0);
    EXPECT_NEAR(floors.median_floor, 0.5 / 11.0, 1e-12);
    EXPECT_NEAR(floors.median_ratio, 0.5 * (8.0 / 11.0 + 2.0 / 5.0), 1e-12);
    EXPECT_EQ(CalcGftFloors(summarised.scenes, kNewPreGrasp, "shadow").num_scenes, 0);
  }
  // Where thumb and finger have the same median, nothing is shifted and GFT% is its floor.
  for (TrialRecord& record : campaign.benchmark.records) {
    if (record.plan.object != "can" || record.plan.grasp != "new-pregrasp") continue;
    record.result.contacts[1].time = 3.0;
    record.result.timing = CalcContactTiming(record.result.contacts, 0.0);
  }
  const Summarised summarised(campaign);
  const GftFloors floors = CalcGftFloors(summarised.scenes, kNewPreGrasp);
  EXPECT_EQ(floors.num_near, 1);
  const std::string text = DescribeGftFloors(floors, kNewPreGrasp);
  EXPECT_NE(text.find("1 of 2 scenes reach at most 1.2 times their floor"), std::string::npos)
      << text;
}

// GFT% is 0, 10, .. 90 % in ten trials: median 45 %. Where the digits of the last ones never touch,
// the others keep their places, until half are infinite.
TEST(GftFloors, ATrialWithoutContactIsTheWorstAsInTheOptimisation) {
  for (const int num_touching : {10, 7, 6, 5}) {
    Campaign campaign = MakeCampaign();
    std::vector<LearningTrial> trials;
    for (TrialRecord& record : campaign.benchmark.records) {
      if (record.plan.object != "can" || record.plan.grasp != "new-pregrasp") continue;
      const int k = record.plan.trial;
      // Thumb and finger change places, so that their medians are nearly the same.
      const double first = 1.0 - 0.1 * k, later = 1.0;
      record.result.contacts = {{"TH", true, k % 2 == 0 ? first : later},
                                {"FF", false, k % 2 == 0 ? later : first}};
      if (k >= num_touching) record.result.contacts[0].time = std::nan("");
      record.result.timing = CalcContactTiming(record.result.contacts, 0.0);
      LearningTrial trial;
      trial.contacts = record.result.contacts;
      trial.timing = record.result.timing;
      trials.push_back(trial);
    }
    const Summarised summarised(campaign);
    const CellSummary& cell = summarised.scenes[0].cell(kNewPreGrasp);
    const double ratio = CalcCellValue(FindVariantMeasure("GFT%"), cell);
    const Answer<double> floor = CalcGftFloorOf(cell.records);
    const Answer<double> learned = CalcGftFloor(trials);
    ASSERT_EQ(floor.has_value(), learned.has_value()) << num_touching;
    if (num_touching == 5) {
      EXPECT_FALSE(floor);
      EXPECT_TRUE(std::isnan(ratio));
      continue;
    }
    EXPECT_NEAR(ratio, 0.45, 1e-12) << num_touching;
    EXPECT_EQ(ratio, CalcMedianGftRatio(trials));
    EXPECT_EQ(*floor, *learned);
  }
}

TEST(GftFloors, WithoutContactsThereIsNone) {
  Campaign campaign = MakeCampaign();
  for (TrialRecord& record : campaign.benchmark.records) record.result.contacts.clear();
  const Summarised summarised(campaign);
  const GftFloors floors = CalcGftFloors(summarised.scenes, kStandardGrasp);
  EXPECT_EQ(floors.num_scenes, 0);
  EXPECT_EQ(floors.num_without, 2);
  EXPECT_EQ(DescribeGftFloors(floors, kStandardGrasp),
            std::string(WordsOf(kStandardGrasp)) + ": no scene has a floor of GFT%");
  EXPECT_EQ(CalcGftFloorOf(summarised.scenes[0].cell(kStandardGrasp).records).reason(),
            "fewer than two digits touched");
}

}  // namespace

}  // namespace graspbench
