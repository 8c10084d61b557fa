#include "datasets/session/worker_log.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/base/error.h"
#include "core/base/files.h"
#include "datasets/session/session_store.h"
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
  const std::vector<WorkerStart> starts = LoadWorkers(folder_.path(), findings);
  EXPECT_TRUE(findings.entries().empty());
  ASSERT_EQ(starts.size(), 2u);
  EXPECT_TRUE(starts[1].machine == MakeMachine("node2"));
  EXPECT_FALSE(starts[1].machine == MakeMachine("node1"));
  EXPECT_EQ(FormatWorkerLine(starts[0]), FormatWorkerLine(MakeStart("node1")));
  EXPECT_EQ(LoadWorkers(folder_.path(), findings, "2of2").size(), 1u);
  EXPECT_TRUE(LoadSession(folder_.path()).machine_differences.empty());
}

TEST_F(WorkerLogTest, OneWorkerAShard) {
  const WorkerLog first(folder_.path(), "1of2");
  const WorkerLog other(folder_.path(), "2of2");
  try {
    const WorkerLog second(folder_.path(), "1of2");
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::kIo);
    EXPECT_NE(std::string(error.what()).find("another process works on shard 1of2"),
              std::string::npos);
  }
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
  EXPECT_EQ(LoadWorkers(folder_.path(), findings).size(), 2u);
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
                          "fedcba9876543210) disagrees with node2 (",
                          0),
            0u)
      << said[0];
  EXPECT_NE(said[0].find("and 1 other machine: in sentinel trial " + plan_[0].id),
            std::string::npos)
      << said[0];
  EXPECT_NE(said[0].find("1 of "), std::string::npos);
  EXPECT_NE(said[0].find("most result.lift_height_m: 0.5 and 0.25, by a part of 0.5 of it"),
            std::string::npos)
      << said[0];
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
  EXPECT_NE(said[0].find(std::string("result.outcome: \"") + NameOf(after) + "\" and \"" +
                         NameOf(before) + "\""),
            std::string::npos)
      << said[0];
}

TEST(ParseWorkerLine, RefusesWhatIsNone) {
  EXPECT_THROW(ParseWorkerLine("{}"), Error);
  EXPECT_THROW(ParseWorkerLine(""), Error);
}

}  // namespace
}  // namespace graspbench
