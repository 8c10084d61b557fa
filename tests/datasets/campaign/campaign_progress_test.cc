#include "datasets/campaign/campaign_progress.h"

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "datasets/campaign/campaign_store.h"
#include "datasets/shards/worker_log.h"
#include "tests/datasets/campaign/fake_scene.h"
#include "tests/datasets/session/fake_session.h"

namespace graspbench {
namespace {
namespace fs = std::filesystem;

TEST(CampaignProgress, TellsTheScenesOfEachShard) {
  const TemporaryFolder folder;
  EXPECT_THROW(ReadCampaignProgress(folder.path(), 60.0), Error);
  CreateCampaign(folder.path(), CampaignConfig());
  const fs::path scenes = folder.path() / "scenes";
  WriteScene(scenes / "tum-can", "can", {1.0}, true);
  WriteScene(scenes / "tum-cup", "cup", {}, false);
  WriteScene(scenes / "tum-mug", "mug", {1.0}, false);
  EXPECT_TRUE(ReadCampaignProgress(folder.path(), 60.0).shards.empty());
  WorkerLog(folder.path(), "1of2").Append(WorkerStart{"1of2", "2026-01-31T12:00:00Z", {}, {}});
  WorkerLog(folder.path(), "2of2").Append(WorkerEnd{"2of2", "2026-01-31T12:00:00Z", 1});
  const CampaignProgress progress = ReadCampaignProgress(folder.path(), 60.0);
  EXPECT_EQ(progress.num_scenes, 3);
  EXPECT_EQ(progress.num_finished, 1);
  EXPECT_FALSE(progress.benchmark);
  ASSERT_EQ(progress.shards.size(), 2u);
  EXPECT_EQ(progress.shards[0].num_trials, 2);  // can and mug
  EXPECT_EQ(progress.shards[0].num_finished, 1);
  EXPECT_EQ(progress.shards[0].state, ShardState::kRunning);
  EXPECT_EQ(progress.shards[1].num_trials, 1);
  EXPECT_EQ(progress.shards[1].state, ShardState::kStopped);
}

TEST(SearchProgress, TellsAnswersAndState) {
  const TemporaryFolder folder;
  WriteScene(folder.path() / "a", "can", {}, false);
  WriteScene(folder.path() / "b", "can", {1.0, 2.0}, false);
  WriteScene(folder.path() / "c", "can", {1.0, 2.0}, true);
  const SearchProgress a = ReadSearchProgress(folder.path() / "a"),
                       b = ReadSearchProgress(folder.path() / "b"),
                       c = ReadSearchProgress(folder.path() / "c");
  EXPECT_EQ(a.num_answers, 0);
  EXPECT_FALSE(a.age || a.is_finished);
  EXPECT_EQ(b.num_answers, 2);
  EXPECT_TRUE(b.age && !b.is_finished);
  EXPECT_TRUE(c.is_finished);
}

}  // namespace
}  // namespace graspbench
