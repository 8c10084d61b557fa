#include "workbench/experiments/judge_grasps.h"

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/base/files/files.h"
#include "datasets/judged_grasps/grasp_store.h"
#include "tests/datasets/session/fake_session.h"
#include "tests/workbench/experiments/pinch_inputs.h"

namespace graspbench {

namespace {

namespace fs = std::filesystem;

const GraspInputs& Inputs() {
  static const GraspInputs inputs = MakePinchInputs();
  return inputs;
}

JudgeGraspsRequest MakeRequest(const fs::path& folder, const std::string& out) {
  JudgeGraspsRequest request;
  request.profiles = {MakePinchProfile()};
  request.profiles[0].name = "pinch";
  request.jitter = 14;  // 45 tasks: several batches
  request.out = folder / out;
  return request;
}

/** Stops after so many verdicts. */
class Stopper : public Observer {
 public:
  explicit Stopper(int num_verdicts) : Observer(stop_), num_verdicts_(num_verdicts) {}
  void ShowStatus(const BatchStatus& status, int) override {
    if (status.num_done >= num_verdicts_) stop_ = true;
  }

 private:
  int num_verdicts_;
  std::atomic<bool> stop_ = false;
};

TEST(JudgeGrasps, VerdictsAreThoseOfMechanics) {
  const TemporaryFolder folder;
  JudgeGraspsRequest request = MakeRequest(folder.path(), "judged");
  request.jitter = 0;
  Observer nobody;
  EXPECT_TRUE(JudgeGrasps(request, Inputs(), nobody));
  const std::vector<JudgedGrasp> judged = LoadJudgedGrasps(request.out);
  ASSERT_EQ(judged.size(), 3u);
  EXPECT_TRUE(judged[0].result.passed) << judged[0].result.reason;
  EXPECT_FALSE(judged[1].result.passed);
  EXPECT_EQ(judged[1].result.failed_stage, "push -y") << judged[1].result.reason;
  EXPECT_EQ(judged[2].result.failed_stage, "squeeze") << judged[2].result.reason;
  EXPECT_EQ(judged[2].result.touching, "");
  EXPECT_EQ(judged[0].label, "success");
  const JudgedSummary summary = SummariseJudged(judged, FindLimits(LoadGraspConfig(request.out)));
  EXPECT_EQ(summary.profiles.front().profile, "pinch");
  EXPECT_EQ(summary.profiles.front().num_passed, 1);
}

// The other profile judges all three, as it does alone.
TEST(JudgeGrasps, AProfileThatDoesNotFitLeavesTheOthersToJudge) {
  const TemporaryFolder folder;
  Observer nobody;
  JudgeGraspsRequest request = MakeRequest(folder.path(), "judged");
  request.jitter = 0;
  request.profiles.push_back(request.profiles[0]);
  request.profiles[1].name = "other";
  GraspInputs inputs = MakePinchInputs();
  inputs.grasps[1].unfit = {1};
  EXPECT_TRUE(JudgeGrasps(request, inputs, nobody));
  const std::vector<JudgedGrasp> judged = LoadJudgedGrasps(request.out);
  ASSERT_EQ(judged.size(), 5u);
  EXPECT_EQ(judged[2].profile, "pinch");
  EXPECT_EQ(judged[2].index, inputs.grasps[1].grasp.index);
  EXPECT_EQ(judged[3].index, inputs.grasps[2].grasp.index);
  EXPECT_TRUE(JudgeGrasps(request, inputs, nobody)) << "the same request again has nothing to do";
  EXPECT_EQ(LoadJudgedGrasps(request.out).size(), 5u);
}

TEST(JudgeGrasps, WorkersAndInterruptionsLeaveTheSameBytes) {
  const TemporaryFolder folder;
  Observer nobody;
  const JudgeGraspsRequest plain = MakeRequest(folder.path(), "plain");
  EXPECT_TRUE(JudgeGrasps(plain, Inputs(), nobody));
  JudgeGraspsRequest stopped = MakeRequest(folder.path(), "stopped");
  stopped.num_workers = 2;
  Stopper stopper(3);
  EXPECT_FALSE(JudgeGrasps(stopped, Inputs(), stopper));
  EXPECT_FALSE(fs::exists(stopped.out / "grasps.csv"));
  // And what a kill leaves of a line.
  const fs::path journal = stopped.out / "journal.jsonl";
  const std::string lines = ReadFile(journal);
  ASSERT_GT(lines.size(), 10u);
  WriteFile(journal, lines + lines.substr(0, 50));
  EXPECT_TRUE(JudgeGrasps(stopped, Inputs(), nobody));
  for (const char* name : {"grasps.json", "journal.jsonl", "grasps.csv", "manifest.json"}) {
    EXPECT_EQ(ReadFile(plain.out / name), ReadFile(stopped.out / name)) << name;
  }
}

TEST(JudgeGrasps, ShardsMergeToTheBytesOfOneRun) {
  const TemporaryFolder folder;
  Observer nobody;
  const JudgeGraspsRequest plain = MakeRequest(folder.path(), "plain");
  EXPECT_TRUE(JudgeGrasps(plain, Inputs(), nobody));
  std::vector<fs::path> parts;
  for (const int number : {2, 1}) {
    JudgeGraspsRequest part = MakeRequest(folder.path(), "part" + std::to_string(number));
    part.shard = {number, 2};
    parts.push_back(part.out);
    EXPECT_TRUE(JudgeGrasps(part, Inputs(), nobody));
  }
  const fs::path merged = folder.path() / "merged";
  MergeJudgedGrasps(parts, merged);
  for (const char* name : {"grasps.json", "journal.jsonl", "grasps.csv"}) {
    EXPECT_EQ(ReadFile(plain.out / name), ReadFile(merged / name)) << name;
  }
  const auto refuse = [&](const std::vector<fs::path>& some) {
    EXPECT_THROW(MergeJudgedGrasps(some, folder.path() / "other"), Error);
  };
  refuse({parts[0]});
  refuse({parts[0], parts[0]});
  refuse({plain.out, parts[0]});
  JudgeGraspsRequest other = MakeRequest(folder.path(), "other1");
  other.shard = {1, 2};
  other.jitter = 1;
  EXPECT_TRUE(JudgeGrasps(other, Inputs(), nobody));
  refuse({parts[0], other.out});
  // A shard's folder takes nothing but its shard.
  JudgeGraspsRequest all = MakeRequest(folder.path(), "part1");
  EXPECT_THROW(JudgeGrasps(all, Inputs(), nobody), Error);
  fs::remove(parts[1] / "grasps.csv");
  refuse(parts);
}

TEST(JudgeGrasps, AnotherProfileNeedsAnotherFolder) {
  const TemporaryFolder folder;
  Observer nobody;
  JudgeGraspsRequest request = MakeRequest(folder.path(), "judged");
  request.jitter = 0;
  EXPECT_TRUE(JudgeGrasps(request, Inputs(), nobody));
  request.profiles[0].max_shift *= 2.0;
  EXPECT_THROW(JudgeGrasps(request, Inputs(), nobody), Error);
}

TEST(ExplainGrasp, NamesTheValueThatTurnsTheVerdict) {
  const GraspInputs inputs = MakePinchInputs();
  const FreeSpaceProfile from = MakePinchProfile();
  FreeSpaceProfile to = from;
  to.drives.damping = 0.04;     // of given drives: nothing changes
  to.surfaces.friction = 0.05;  // 0.5 N at most, and the push is 1 N
  to.test_time = 0.2;
  const std::vector<ExplainStep> steps = ExplainGrasp(inputs, inputs.grasps.front(), from, to);
  ASSERT_EQ(steps.size(), 4u);
  EXPECT_TRUE(steps[0].result.passed) << steps[0].result.reason;
  EXPECT_EQ(steps[1].key, "drives.damping_nms_per_rad");
  EXPECT_FALSE(steps[1].turns);
  EXPECT_EQ(steps[2].key, "surfaces.friction");
  EXPECT_TRUE(steps[2].turns);
  EXPECT_EQ(steps[2].from, "0.5");
  EXPECT_FALSE(steps[2].result.passed);
  EXPECT_EQ(steps[3].key, "test_time_s");
}

}  // namespace

}  // namespace graspbench
