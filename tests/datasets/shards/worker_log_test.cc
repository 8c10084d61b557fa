#include "datasets/shards/worker_log.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/base/error.h"
#include "core/base/files/files.h"
#include "datasets/session/session_store.h"
#include "datasets/shards/shard.h"
#include "tests/datasets/find_error.h"
#include "tests/datasets/session/fake_session.h"

namespace graspbench {
namespace {
namespace fs = std::filesystem;

Machine MakeMachine(const std::string& host) {
  return {host, "a processor", "0123456789abcdef", "glibc 2.36", "fedcba9876543210", "0.1.0"};
}

class WorkerLogTest : public testing::Test {
 protected:
  WorkerLogTest() {
    for (const PlannedTrial& planned : {plan_[0], plan_[1]}) {
      sentinels_.push_back(MakeFakeRecord(planned));
    }
  }
  WorkerStart MakeStart(const std::string& host) const {
    return {"1of2", "2026-01-31T12:00:00Z", MakeMachine(host), sentinels_};
  }
  TemporaryFolder folder_;
  const std::vector<PlannedTrial> plan_ = CreateFakeSession(folder_.path(), 2);
  std::vector<TrialRecord> sentinels_;
};

TEST_F(WorkerLogTest, ReadsWhatItWrote) {
  WorkerLog(folder_.path(), "1of2").Append(MakeStart("node1"));
  WorkerLog(folder_.path(), "2of2").Append(MakeStart("node2"));
  Diagnostics findings;
  const std::vector<WorkerStart> starts = LoadWorkers(folder_.path(), findings).starts;
  EXPECT_TRUE(findings.entries().empty());
  ASSERT_EQ(starts.size(), 2u);
  EXPECT_TRUE(starts[1].machine == MakeMachine("node2"));
  EXPECT_FALSE(starts[1].machine == MakeMachine("node1"));
  EXPECT_EQ(FormatWorkerLine(starts[0]), FormatWorkerLine(MakeStart("node1")));
  EXPECT_TRUE(LoadSession(folder_.path()).machine_differences.empty());
}

TEST_F(WorkerLogTest, RemembersWhoIsAtRest) {
  WorkerLog first(folder_.path(), "1of2"), second(folder_.path(), "2of2");
  first.Append(MakeStart("node1"));
  first.Append(WorkerEnd{"1of2", "2026-01-31T12:00:05Z", 7});
  second.Append(MakeStart("node2"));
  Diagnostics findings;
  EXPECT_EQ(LoadWorkers(folder_.path(), findings).at_rest, std::set<std::string>{"1of2"});
  WorkerStart again = MakeStart("node1");
  again.started_utc = "2026-01-31T12:00:05Z";
  first.Append(again);
  const Workers workers = LoadWorkers(folder_.path(), findings);
  EXPECT_TRUE(workers.at_rest.empty());
  EXPECT_EQ(workers.starts.size(), 3u);
  EXPECT_TRUE(findings.entries().empty());
}

TEST_F(WorkerLogTest, KnowsOfWhichMachinesNoSentinelsAreKept) {
  WorkerStart bare = MakeStart("node1");
  bare.shard = "2of2";
  bare.sentinels.clear();
  std::vector<WorkerStart> starts = {MakeStart("node1"), bare};
  EXPECT_TRUE(FindUnchecked(folder_.path(), starts).empty());
  EXPECT_TRUE(DescribeUnchecked({}).empty());
  bare.machine.processor_flags = "another";
  starts[1] = bare;
  EXPECT_EQ(FindUnchecked(folder_.path(), starts), std::set<std::string>{"2of2"});
  JournalWriter(folder_.path(), 0, "3of7").Append(MakeFakeRecord(plan_[0]));
  JournalWriter(folder_.path(), 0).Append(MakeFakeRecord(plan_[1]));  // of a run
  const std::set<std::string> unchecked = {"2of2", "3of7"};
  EXPECT_EQ(FindUnchecked(folder_.path(), starts), unchecked);
  const std::vector<std::string> said = LoadSession(folder_.path()).machine_differences;
  ASSERT_EQ(said.size(), 1u);
  EXPECT_TRUE(Has(said[0], "1 shard (3of7)"));
}

TEST_F(WorkerLogTest, FindsTheSentinelsOfAMachine) {
  const auto has = [&](const WorkerStart& start, const std::string& host) {
    return HasSentinels({start}, MakeMachine(host), plan_);
  };
  WorkerStart start = MakeStart("node1");
  start.sentinels.clear();
  EXPECT_FALSE(has(start, "node1"));
  for (const PlannedTrial& planned : ListSentinels(plan_)) {
    start.sentinels.push_back(MakeFakeRecord(planned));
  }
  EXPECT_TRUE(has(start, "node1"));
  EXPECT_FALSE(has(start, "node2"));
  start.sentinels.pop_back();
  EXPECT_FALSE(has(start, "node1"));
}

TEST_F(WorkerLogTest, OneWorkerAShard) {
  const WorkerLog first(folder_.path(), "1of2");
  const WorkerLog other(folder_.path(), "2of2");
  EXPECT_TRUE(Throws([&] { const WorkerLog second(folder_.path(), "1of2"); }, ErrorKind::kIo,
                     "another process works on shard 1of2"));
}

// A seal of whole lines stays true, whatever a killed worker left behind them.
TEST_F(WorkerLogTest, TornLinesStayAndAreNotContinued) {
  const fs::path torn = folder_.path() / "workers" / "1of2-0.jsonl";
  WorkerLog(folder_.path(), "1of2").Append(MakeStart("node1"));
  const std::string whole = ReadFile(torn);
  WriteFile(torn, whole + whole.substr(0, 40));
  SealStore(kSessionStore, folder_.path());
  WorkerLog(folder_.path(), "1of2").Append(MakeStart("node2"));
  EXPECT_EQ(ReadFile(torn), whole + whole.substr(0, 40));
  EXPECT_TRUE(fs::exists(folder_.path() / "workers" / "1of2-0-2.jsonl"));
  EXPECT_TRUE(CheckStore(folder_.path()).damages.empty());
  Diagnostics findings;
  EXPECT_EQ(LoadWorkers(folder_.path(), findings).starts.size(), 2u);
  WriteFile(torn, whole.substr(0, 30));
  EXPECT_FALSE(CheckStore(folder_.path()).damages.empty());
}

TEST_F(WorkerLogTest, NamesTheMachineThatDisagreesAndByHowMuch) {
  std::vector<WorkerStart> starts = {MakeStart("node1"), MakeStart("node2"), MakeStart("node3")};
  EXPECT_TRUE(DescribeDifferences(starts).empty());
  starts[0].sentinels[0].result.lift_height = 0.5;
  starts[0].sentinels[1].result.grip_force *= 1.0 + 1e-12;
  sentinels_[0].result.lift_height = 0.25;
  starts[1] = MakeStart("node2");
  starts[2] = MakeStart("node3");
  const std::vector<std::string> said = DescribeDifferences(starts);
  ASSERT_EQ(said.size(), 1u);
  EXPECT_EQ(said[0].rfind("node1 (a processor, flags 0123456789abcdef, glibc 2.36, build "
                          "fedcba9876543210), shard 1of2, disagrees with node2 (",
                          0),
            0u)
      << said[0];
  EXPECT_TRUE(Has(said[0], "and 1 other machine: in sentinel trial " + plan_[0].id));
  EXPECT_TRUE(Has(said[0], "1 of "));
  EXPECT_TRUE(Has(said[0], "most result.lift_height_m: 0.5 and 0.25, by a part of 0.5 of it"));
  std::reverse(starts.begin(), starts.end());
  EXPECT_EQ(DescribeDifferences(starts), said);
}

TEST_F(WorkerLogTest, SaysWhenAnOutcomeDiffers) {
  std::vector<WorkerStart> starts = {MakeStart("node1"), MakeStart("node2"), MakeStart("node3")};
  const Outcome before = starts[2].sentinels[0].result.outcome;
  const Outcome after =
      before == Outcome::kSuccess ? Outcome::kSlippedInLiftOff : Outcome::kSuccess;
  starts[2].sentinels[0].result.outcome = after;
  const std::vector<std::string> said = DescribeDifferences(starts);
  ASSERT_EQ(said.size(), 1u);
  EXPECT_EQ(said[0].rfind("node3 (", 0), 0u);
  EXPECT_TRUE(Has(said[0], std::string("result.outcome: \"") + NameOf(after) + "\" and \"" +
                               NameOf(before) + "\""));
}

}  // namespace
}  // namespace graspbench
