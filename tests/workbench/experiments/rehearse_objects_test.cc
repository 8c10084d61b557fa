#include "workbench/experiments/rehearse_objects.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "core/base/error.h"
#include "core/base/files/files.h"
#include "datasets/campaign/check_records.h"
#include "tests/datasets/find_error.h"
#include "tests/datasets/session/fake_session.h"

namespace graspbench {
namespace {

namespace fs = std::filesystem;

/** Three objects with the TUM Hand. */
RehearseRequest MakeRehearseRequest(const fs::path& out, RehearsalConfig rehearsal = {5, 2}) {
  SessionConfig config;
  config.hands = {"tum"};
  config.objects = {"golf_ball", "can", "matchbox"};
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
