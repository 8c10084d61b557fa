#include "datasets/analysis/campaign/campaign_export.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/files/files.h"
#include "tests/datasets/session/fake_session.h"

namespace graspbench {
namespace {

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
            "gft_ratio_floor,median_got_ratio,median_gct_s,mean_breaking_force_n,median_grip_n,"
            "median_sigma_per_grip,median_breaking_per_grip,headroom_share\n"
            "tum,mug,g2,standard,2,1,1.5,,,,0.5,0.0,,,,\n"
            "tum,mug,new-pregrasp,new-pregrasp,2,1,1.5,,,,0.5,0.0,,,,0.5\n"
            "tum,mug,new-target,new-target,2,1,1.5,,,,0.5,0.0,,,,0.75\n");
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
