#include "workbench/tables/progress_tables.h"

#include <gtest/gtest.h>

namespace graspbench {
namespace {

SessionProgress MakeProgress() {
  SessionProgress progress;
  progress.num_trials = 7;
  progress.num_finished = 4;
  progress.shards = {{{1, 2}, 4, 4, 3.0, ShardState::kFinished},
                     {{2, 2}, 3, 0, std::nullopt, ShardState::kWaiting}};
  return progress;
}

TEST(FormatShards, HasARowAShard) {
  const std::string text = FormatShards(MakeProgress().shards, "trials");
  EXPECT_NE(text.find("\n1/2         4         4  finished"), std::string::npos) << text;
  EXPECT_NE(text.find("\n2/2         3         0  waiting                 n/a"), std::string::npos)
      << text;
  EXPECT_EQ(FormatShards({}, "trials"), "");
}

TEST(MakeStatusJson, SaysWhatNobodyHasBegun) {
  const Json json = MakeStatusJson(MakeProgress());
  EXPECT_EQ(json["shards"][0]["age_s"], 3.0);
  EXPECT_TRUE(json["shards"][1]["age_s"].is_null());
  EXPECT_TRUE(json["judge"].is_null());
  CampaignProgress campaign;
  EXPECT_TRUE(MakeStatusJson(campaign)["benchmark"].is_null());
  campaign.benchmark = MakeProgress();
  campaign.benchmark->judge = JudgeProgress{5, 2, {}};
  EXPECT_EQ(MakeStatusJson(campaign)["benchmark"]["judge"]["held_grasps"], 5);
}

}  // namespace
}  // namespace graspbench
