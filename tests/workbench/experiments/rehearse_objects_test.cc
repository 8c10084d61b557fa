#include "workbench/experiments/rehearse_objects.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "core/base/error.h"
#include "core/base/files/files.h"
#include "core/grasp/grasp_file.h"
#include "core/trial/trial_runner.h"
#include "datasets/campaign/check_records.h"
#include "datasets/grasps/map_to_hand.h"
#include "objects/catalogue.h"
#include "tests/datasets/find_error.h"
#include "tests/datasets/session/fake_session.h"

namespace graspbench {
namespace {

namespace fs = std::filesystem;

RehearseRequest MakeRehearseRequest(const fs::path& out, RehearsalConfig rehearsal = {5, 2},
                                    const std::string& hand = "tum",
                                    const std::vector<std::string>& objects = {"golf_ball", "can",
                                                                               "matchbox"}) {
  SessionConfig config;
  config.hands = {hand};
  config.objects = objects;
  RehearseRequest request;
  request.tasks = ListRehearsalTasks(config, rehearsal);
  request.out = out;
  return request;
}

/** What is kept between runs is kept in a folder of these tests. */
class RehearseObjectsTest : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    cache_ = new TemporaryFolder;
    ::setenv("XDG_CACHE_HOME", cache_->path().c_str(), 1);
  }
  static void TearDownTestSuite() {
    ::unsetenv("XDG_CACHE_HOME");
    delete cache_;
  }

 private:
  static inline TemporaryFolder* cache_ = nullptr;
};

/** Forgets what earlier rehearsals have kept. */
void ForgetRehearsals() { fs::remove_all(FindCacheRoot() / "rehearsals"); }

class StopAtOnce : public Observer {
 public:
  StopAtOnce() : Observer(stop_) {}
  void ShowStatus(const BatchStatus& status, int) override {
    if (status.num_done >= 1) stop_ = true;
  }

 private:
  std::atomic<bool> stop_ = false;
};

TEST_F(RehearseObjectsTest, WorkersInterruptionsAndShardsLeaveTheSameBytes) {
  const TemporaryFolder folder;
  Observer nobody;
  ForgetRehearsals();
  const RehearseRequest plain = MakeRehearseRequest(folder.path() / "plain");
  EXPECT_EQ(RehearseObjects(plain, nobody).size(), 3u);

  ForgetRehearsals();
  RehearseRequest stopped = MakeRehearseRequest(folder.path() / "stopped");
  stopped.num_workers = 2;
  StopAtOnce stopper;
  try {
    RehearseObjects(stopped, stopper);
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::kInterrupted);
    EXPECT_FALSE(fs::exists(stopped.out / kCandidateTable));
  }
  RehearseObjects(stopped, nobody);

  ForgetRehearsals();
  RehearseRequest merged = MakeRehearseRequest(folder.path() / "merged");
  for (const int number : {2, 1}) {
    const fs::path part = folder.path() / ("part" + std::to_string(number));
    RehearseRequest shard = MakeRehearseRequest(part);
    shard.shard = {number, 2};
    EXPECT_EQ(RehearseObjects(shard, nobody).size(), number == 1 ? 2u : 1u);
    merged.parts.push_back(part.string());
  }
  ForgetRehearsals();
  RehearseObjects(merged, nobody);
  EXPECT_FALSE(fs::exists(FindCacheRoot() / "rehearsals")) << "nothing was to be run";
  for (const char* name : {"rehearsal.json", "journal.jsonl", "candidates.csv", "manifest.json",
                           "grasps/tum/golf_ball.yaml", "grasps/tum/can.yaml"}) {
    EXPECT_EQ(ReadFile(plain.out / name), ReadFile(stopped.out / name)) << name;
    EXPECT_EQ(ReadFile(plain.out / name), ReadFile(merged.out / name)) << name;
  }
}

TEST_F(RehearseObjectsTest, AnotherRequestAndADamagedLineAreRefused) {
  const TemporaryFolder folder;
  Observer nobody;
  const RehearseRequest request = MakeRehearseRequest(folder.path() / "a");
  RehearseObjects(request, nobody);
  EXPECT_TRUE(Throws(
      [&] {
        RehearseObjects(MakeRehearseRequest(folder.path() / "a", {5, 3}), nobody);
      },
      ErrorKind::kUsage, "draws"));
  const fs::path journal = request.out / "journal.jsonl";
  std::string lines = ReadFile(journal);
  lines[lines.find("outcomes") + 14] ^= 1;
  WriteFile(journal, lines);
  EXPECT_THROW(LoadRehearsals(request.out), Error);
  EXPECT_THROW(RehearseObjects(request, nobody), Error);
}

// Read and mapped onto the hand again, a written grasp has the poses and postures of the grasp file,
// closed half way from contact to target.
TEST_F(RehearseObjectsTest, OtherProgramsGetTheChosenGrasp) {
  const TemporaryFolder folder;
  Observer nobody;
  const RehearseRequest request =
      MakeRehearseRequest(folder.path() / "out", {3, 1}, "shadow", {"golf_ball"});
  RehearseObjects(request, nobody);
  const RehearsalTask& task = request.tasks.front();
  const Grasp grasp =
      LoadGraspFile((request.out / "grasps/shadow/golf_ball.yaml").string(), {task.hand.get()})
          .grasp;
  Pose X_OH = grasp.placement->X_WH;
  X_OH.pretranslate(Eigen::Vector3d(0.0, 0.0, -0.5 * task.object->size.z()));
  const Eigen::VectorXd pressed =
      CalcClosingPosture(*task.hand, grasp, 0.5 * (grasp.placement->closing_at_contact + 1.0));
  GraspReadOptions frames;
  frames.hand_frame = task.hand->links.front().name;
  frames.object_frame = "mesh";
  const std::vector<std::pair<std::string, std::vector<std::string>>> files = {
      {"isaac/shadow/golf_ball.yaml", {"pregrasp", "grasp"}},
      {"dexgraspbench/shadow/golf_ball.npy", {"pregrasp", "grasp", "squeeze"}}};
  for (const auto& [name, stages] : files) {
    const std::vector<ForeignGrasp> read =
        ParseGrasps(ReadFile(request.out / name), name, "auto", frames);
    ASSERT_EQ(read.size(), 1u) << name;
    EXPECT_EQ(read[0].object, "golf_ball");
    const HandGrasp mapped = MapToHand(read[0], *task.hand);
    ASSERT_EQ(mapped.stages.size(), stages.size()) << name;
    for (size_t i = 0; i < stages.size(); ++i) {
      EXPECT_EQ(mapped.stages[i].name, stages[i]);
      EXPECT_TRUE(mapped.stages[i].X_OH.isApprox(X_OH, 1e-7)) << name << ", " << stages[i];
    }
    EXPECT_TRUE(mapped.stages.front().q.isApprox(grasp.q_pre, 1e-7)) << name;
    EXPECT_TRUE(mapped.stages.back().q.isApprox(pressed, 1e-7)) << name;
  }
}

// Far from where the object should be the rehearsed grasp holds it only when the hand goes with what
// its camera finds.
TEST_F(RehearseObjectsTest, ARehearsedGraspIsAppliedAtThePoseThatTheCameraFinds) {
  SessionConfig config;
  config.hands = {"tum"};
  config.objects = {"board_marker"};
  RehearsalTask task = ListRehearsalTasks(config, {5, 1}).front();
  task.object = CompleteObject(task.object);
  const Rehearsal rehearsal = FindRehearsal(task);
  ASSERT_TRUE(rehearsal.is_robust());
  const Grasp grasp =
      CandidateMaker(*task.hand, task.grasps, *task.object).Make(rehearsal.choice().candidate);
  TrialSetup setup = MakeRehearsalSetup(task, task.object, grasp, {0});
  setup.draw.offset_x = 0.03;
  setup.draw.offset_y = -0.02;
  setup.draw.offset_yaw = 1.0;
  TrialRunner runner(setup.hand, setup.object);
  EXPECT_FALSE(IsSuccess(runner.Run(setup).outcome));
  setup.positioning = Positioning::kCamera;
  const TrialResult seen = runner.Run(setup);
  EXPECT_TRUE(IsSuccess(seen.outcome)) << seen.reason;
  EXPECT_NEAR(seen.believed_x, setup.draw.offset_x, 0.002);
  EXPECT_NEAR(seen.believed_yaw, setup.draw.offset_yaw, 0.05);
}

TEST_F(RehearseObjectsTest, ASessionAsksForWhatIsNotKept) {
  ForgetRehearsals();
  SessionConfig config;
  config.hands = {"tum"};
  config.objects = {"golf_ball", "can"};
  EXPECT_TRUE(ListUnrehearsed(config).empty());
  config.grasps = {"best", "rehearsed-5-2"};
  const std::vector<RehearsalTask> tasks = ListUnrehearsed(config);
  ASSERT_EQ(tasks.size(), 2u);
  Observer nobody;
  EXPECT_EQ(RehearseTasks(tasks, 2, nobody).size(), 2u);
  EXPECT_TRUE(ListUnrehearsed(config).empty());
}

}  // namespace
}  // namespace graspbench
