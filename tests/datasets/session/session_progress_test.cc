#include "datasets/session/session_progress.h"

#include <gtest/gtest.h>

#include <chrono>

#include "core/base/error.h"
#include "core/base/files/files.h"
#include "datasets/session/judgement_store.h"
#include "datasets/session/session_store.h"
#include "datasets/shards/worker_log.h"
#include "tests/datasets/session/fake_session.h"

namespace graspbench {
namespace {
namespace fs = std::filesystem;

class ReadProgressTest : public testing::Test {
 protected:
  void Finish(const Shard& shard, size_t num_trials) {
    JournalWriter journal(folder_.path(), 0, FormatLabel(shard));
    const std::vector<PlannedTrial> trials = PartitionPlan(plan_, shard);
    for (size_t i = 0; i < std::min(num_trials, trials.size()); ++i) {
      journal.Append(MakeFakeRecord(trials[i]));
    }
  }
  TemporaryFolder folder_;
  const std::vector<PlannedTrial> plan_ = CreateFakeSession(folder_.path(), 3);
};

TEST_F(ReadProgressTest, TellsFinishedRunningStaleAndWaiting) {
  EXPECT_TRUE(ReadProgress(folder_.path(), 60.0).shards.empty());
  Finish({1, 4}, 100);
  Finish({2, 4}, 1);
  Finish({3, 4}, 2);
  fs::last_write_time(folder_.path() / "journal" / "3of4-0.jsonl",
                      fs::file_time_type::clock::now() - std::chrono::hours(1));
  const SessionProgress progress = ReadProgress(folder_.path(), 60.0);
  EXPECT_EQ(progress.num_trials, static_cast<int>(plan_.size()));
  EXPECT_EQ(progress.num_finished, static_cast<int>(PartitionPlan(plan_, {1, 4}).size()) + 3);
  EXPECT_EQ(progress.num_bad_lines, 0);
  ASSERT_EQ(progress.shards.size(), 4u);
  const ShardState states[] = {ShardState::kFinished, ShardState::kRunning, ShardState::kStale,
                               ShardState::kWaiting};
  for (size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(progress.shards[i].state, states[i]) << i;
    EXPECT_EQ(progress.shards[i].num_trials,
              static_cast<int>(PartitionPlan(plan_, progress.shards[i].shard).size()));
  }
  EXPECT_EQ(progress.shards[2].num_finished, 2);
  EXPECT_GE(*progress.shards[2].age, 3500.0);
  EXPECT_FALSE(progress.shards[3].age);
}

// What another deal or a merge has finished counts for every shard that planned it.
TEST_F(ReadProgressTest, CountsTrialsNotLines) {
  Finish({1, 1}, 100);
  Finish({1, 2}, 100);
  const SessionProgress progress = ReadProgress(folder_.path(), 60.0);
  EXPECT_EQ(progress.num_finished, progress.num_trials);
  ASSERT_EQ(progress.shards.size(), 3u);
  for (const ShardProgress& one : progress.shards) EXPECT_EQ(one.state, ShardState::kFinished);
}

TEST_F(ReadProgressTest, LeavesOutDamagedAndTornLines) {
  Finish({1, 1}, 3);
  fs::remove_all(folder_.path() / "progress");
  const fs::path journal = folder_.path() / "journal" / "1of1-0.jsonl";
  std::string text = ReadFile(journal);
  text[text.find("lift_height") + 16] ^= 1;
  WriteFile(journal, text.substr(0, text.size() - 5));
  const SessionProgress progress = ReadProgress(folder_.path(), 60.0);
  EXPECT_EQ(progress.num_finished, 1);
  EXPECT_EQ(progress.num_bad_lines, 1);
}

// Somebody has edited the journal since: it is read, whatever its index says.
TEST_F(ReadProgressTest, BelievesNoIndexThatIsOlderThanItsJournal) {
  Finish({1, 1}, 3);
  const fs::path journal = folder_.path() / "journal" / "1of1-0.jsonl";
  std::string text = ReadFile(journal);
  text[text.find("lift_height") + 16] ^= 1;
  WriteFile(journal, text);
  const fs::path index = folder_.path() / "progress" / "1of1-0.jsonl";
  fs::last_write_time(index, fs::last_write_time(journal) - std::chrono::seconds(1));
  const SessionProgress progress = ReadProgress(folder_.path(), 60.0);
  EXPECT_EQ(progress.num_finished, 2);
  EXPECT_EQ(progress.num_bad_lines, 1);
}

// A worker that ended with trials left, one that has begun since, and one that was killed.
TEST_F(ReadProgressTest, TellsWhoHasStopped) {
  for (const int number : {1, 2, 3}) Finish({number, 4}, 1);
  const std::string before = "2026-01-31T12:00:00Z", after = "2026-01-31T12:00:09Z";
  WorkerLog first(folder_.path(), "1of4"), second(folder_.path(), "2of4");
  first.Append(WorkerStart{"1of4", before, {}, {}});
  first.Append(WorkerEnd{"1of4", after, 1});
  second.Append(WorkerEnd{"2of4", before, 1});
  second.Append(WorkerStart{"2of4", after, {}, {}});
  const SessionProgress progress = ReadProgress(folder_.path(), 60.0);
  ASSERT_EQ(progress.shards.size(), 4u);
  EXPECT_EQ(progress.shards[0].state, ShardState::kStopped);
  EXPECT_EQ(progress.shards[1].state, ShardState::kRunning);
  EXPECT_EQ(progress.shards[2].state, ShardState::kRunning);
  EXPECT_EQ(progress.shards[3].state, ShardState::kWaiting);
  const std::set<std::string> all = {"1of4", "2of4", "3of4"};
  EXPECT_EQ(progress.unchecked, all);
}

// By their lengths: a file that is gone, and one that has lost committed bytes.
TEST_F(ReadProgressTest, NamesLostBytes) {
  Finish({1, 2}, 3);
  Finish({2, 2}, 3);
  SealStore(kSessionStore, folder_.path());
  EXPECT_TRUE(ReadProgress(folder_.path(), 60.0).damages.empty());
  const fs::path cut = folder_.path() / "journal" / "1of2-0.jsonl";
  fs::resize_file(cut, fs::file_size(cut) - 1);
  fs::remove(folder_.path() / "journal" / "2of2-0.jsonl");
  const std::vector<Damage> damages = ReadProgress(folder_.path(), 60.0).damages;
  ASSERT_EQ(damages.size(), 2u);
  EXPECT_EQ(damages[0].path, "journal/1of2-0.jsonl");
  EXPECT_EQ(damages[1].path + " " + damages[1].text, "journal/2of2-0.jsonl is missing");
}

TEST_F(ReadProgressTest, CountsRecordsOfOtherPlansApart) {
  const TemporaryFolder other;
  const std::vector<PlannedTrial> plan = CreateFakeSession(other.path(), 4);
  {
    JournalWriter journal(folder_.path(), 0, "1of1");
    journal.Append(MakeFakeRecord(plan.back()));
    journal.Append(MakeFakeRecord(plan_[0]));
  }
  const SessionProgress progress = ReadProgress(folder_.path(), 60.0);
  EXPECT_EQ(progress.num_finished, 1);
  EXPECT_EQ(progress.num_foreign_lines, 1);
  EXPECT_EQ(progress.num_bad_lines, 0);
  EXPECT_EQ(FindShardCounts(folder_.path()), std::set<int>{1});
}

// Judged by two, run by one; a worker of the judge says nothing of the trials.
TEST_F(ReadProgressTest, CountsHeldGraspsOfAJudge) {
  Finish({1, 1}, 100);
  EXPECT_FALSE(ReadProgress(folder_.path(), 60.0).judge);
  const Session session = LoadSession(folder_.path());
  std::set<std::string> held;
  for (const PlannedTrial& planned : FindUnjudged(session)) held.insert(planned.id);
  ASSERT_GE(held.size(), 2u);
  int num_first = 0;
  {
    JudgementWriter first(folder_.path(), 0, "1of2");
    for (const PlannedTrial& planned : PartitionPlan(plan_, {1, 2})) {
      if (held.count(planned.id) == 0) continue;
      first.Append(planned.id, Judgement());
      ++num_first;
    }
  }
  WorkerLog worker(folder_.path(), "judge-2of2");
  worker.Append(WorkerStart{"judge-2of2", "2026-01-31T12:00:00Z", {}, {}});
  worker.Append(WorkerEnd{"judge-2of2", "2026-01-31T12:00:09Z", 1});
  const SessionProgress progress = ReadProgress(folder_.path(), 60.0);
  ASSERT_EQ(progress.shards.size(), 1u);
  EXPECT_EQ(progress.shards[0].state, ShardState::kFinished);
  ASSERT_TRUE(progress.judge);
  EXPECT_EQ(progress.judge->num_held, static_cast<int>(held.size()));
  EXPECT_EQ(progress.judge->num_judged, num_first);
  ASSERT_EQ(progress.judge->shards.size(), 2u);
  EXPECT_EQ(progress.judge->shards[0].num_trials, num_first);
  EXPECT_EQ(progress.judge->shards[0].state, ShardState::kFinished);
  EXPECT_EQ(progress.judge->shards[1].num_finished, 0);
  EXPECT_EQ(progress.judge->shards[1].num_trials, static_cast<int>(held.size()) - num_first);
  const bool has_work = static_cast<int>(held.size()) > num_first;  // as the hashes deal it
  EXPECT_EQ(progress.judge->shards[1].state,
            has_work ? ShardState::kStopped : ShardState::kFinished);
}

TEST_F(ReadProgressTest, NeedsASession) {
  EXPECT_THROW(ReadProgress(folder_.path() / "journal", 60.0), Error);
  WriteFile(folder_.path() / "plan.jsonl", "{}\n");
  EXPECT_THROW(ReadProgress(folder_.path(), 60.0), Error);
}

}  // namespace
}  // namespace graspbench
