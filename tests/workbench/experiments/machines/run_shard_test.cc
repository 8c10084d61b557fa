#include "workbench/experiments/machines/run_shard.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include "core/base/error.h"
#include "core/base/files/files.h"
#include "datasets/campaign/campaign_store.h"
#include "datasets/session/merge_sessions.h"
#include "tests/datasets/session/fake_session.h"
#include "workbench/experiments/run_campaign.h"
#include "workbench/experiments/scene_runner.h"

namespace graspbench {

namespace {
namespace fs = std::filesystem;

/** A real session, of few and short trials. */
class WorkOnShardTest : public testing::Test {
 protected:
  WorkOnShardTest()
      : folder_(fs::path(testing::TempDir()) /
                ("work_on_shard_" +
                 std::string(testing::UnitTest::GetInstance()->current_test_info()->name()) + "_" +
                 std::to_string(::getpid()))) {
    fs::remove_all(folder_);
    SessionRequest request;
    request.config = SessionConfig();
    request.config->hands = {"tum"};
    request.config->objects = {"golf_ball", "tea_light"};
    request.config->trials = 2;
    request.config->sim.step = 0.004;
    request.config->strategy.hold_time = 0.2;
    request.out = folder_;
    PrepareSession(request);
    RecordPlanning(folder_);
    request_.folder = folder_;
    request_.shard = {1, 2};
  }
  ~WorkOnShardTest() override { fs::remove_all(folder_); }

  ShardResult Work() { return WorkOnShard(request_, observer_); }
  std::string Refuse(ErrorKind kind) {
    try {
      Work();
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), kind) << error.what();
      EXPECT_TRUE(fs::is_empty(folder_ / "journal"));
      return error.what();
    }
    ADD_FAILURE() << "was not refused";
    return "";
  }
  /** Changes the frozen configuration and seals it anew, as a person with bad intent would. */
  void Forge(const std::string& file, const std::string& from, const std::string& to) {
    std::string text = ReadFile(folder_ / file);
    ASSERT_NE(text.find(from), std::string::npos) << from;
    WriteFile(folder_ / file, text.replace(text.find(from), from.size(), to));
    fs::remove(folder_ / "manifest.json");
    SealStore(kSessionStore, folder_);
  }

  const fs::path folder_;
  ShardRequest request_;
  std::atomic<bool> stop_{false};
  Observer observer_{stop_};
};

TEST_F(WorkOnShardTest, WritesFilesOfItsOwnOnly) {
  const std::string manifest = ReadFile(folder_ / "manifest.json");
  const ShardResult result = Work();
  EXPECT_EQ(result.num_all, 2);
  EXPECT_EQ(result.num_left, 0);
  EXPECT_EQ(ListJournals(folder_).size(), 1u);
  EXPECT_EQ(ListJournals(folder_, "workers").size(), 1u);
  EXPECT_EQ(ReadFile(folder_ / "manifest.json"), manifest);
  EXPECT_TRUE(CheckStore(folder_).damages.empty());
  EXPECT_EQ(Work().num_left, 0);  // nothing more to do
  Diagnostics findings;
  const std::vector<WorkerStart> starts = LoadWorkers(folder_, findings).starts;
  ASSERT_EQ(starts.size(), 1u);
  EXPECT_EQ(starts[0].sentinels.size(), 3u);
}

// However short the time, the same request ends: the sentinels are through and a trial is finished.
TEST_F(WorkOnShardTest, GetsThereInAnyTime) {
  request_.time_budget = 1e-9;
  int num_calls = 0;
  while (Work().num_left > 0 && num_calls < 3) ++num_calls;
  EXPECT_LE(num_calls, 1);
  EXPECT_EQ(LoadShardOfSession(folder_, "1of2").records.size(), 2u);
}

TEST_F(WorkOnShardTest, ReadsNoOtherShard) {
  WriteFile(folder_ / "journal" / "2of2-0.jsonl", "damaged\n");
  EXPECT_EQ(Work().num_left, 0);
  EXPECT_THROW(LoadSession(folder_), Error);  // and so a merge
  WriteFile(folder_ / "journal" / "1of2-0.jsonl", "damaged\n");
  EXPECT_THROW(Work(), Error);
}

// The machine has run them for the first shard; another machine or build runs its own.
TEST_F(WorkOnShardTest, RunsSentinelsOnceAMachine) {
  const auto load = [&] {
    Diagnostics findings;
    return LoadWorkers(folder_, findings).starts;
  };
  Work();
  request_.shard = {2, 2};
  Work();
  ASSERT_EQ(load().size(), 2u);
  EXPECT_EQ(load()[0].sentinels.size(), 3u);
  EXPECT_TRUE(load()[1].sentinels.empty());
  EXPECT_TRUE(FindUnchecked(folder_, load()).empty());
  fs::remove(folder_ / "workers" / "1of2-0.jsonl");
  fs::remove(folder_ / "journal" / "2of2-0.jsonl");
  Work();
  EXPECT_EQ(load().back().sentinels.size(), 3u);
}

// Its file was lost; the shard is finished, but nobody knows what its machine is worth.
TEST_F(WorkOnShardTest, MakesUpLostSentinels) {
  const auto find_unchecked = [&] {
    Diagnostics findings;
    return FindUnchecked(folder_, LoadWorkers(folder_, findings).starts);
  };
  Work();
  fs::remove(folder_ / "workers" / "1of2-0.jsonl");
  EXPECT_EQ(find_unchecked().size(), 1u);
  EXPECT_EQ(Work().num_left, 0);
  EXPECT_TRUE(find_unchecked().empty());
  EXPECT_EQ(LoadShardOfSession(folder_, "1of2").records.size(), 2u);
}

TEST_F(WorkOnShardTest, SaysThatItStopped) {
  const auto is_at_rest = [&] {
    Diagnostics findings;
    return LoadWorkers(folder_, findings).at_rest.count("1of2") > 0;
  };
  stop_ = true;
  EXPECT_EQ(Work().num_left, 2);
  EXPECT_TRUE(ListJournals(folder_).empty());
  EXPECT_TRUE(is_at_rest());
  stop_ = false;
  EXPECT_EQ(Work().num_left, 0);
  EXPECT_TRUE(is_at_rest());
}

TEST_F(WorkOnShardTest, JudgesNothingBeforeAnythingHasRun) {
  request_.judge = true;
  Refuse(ErrorKind::kUsage);
}

// The whole optimisation is one shard, and can be merged from another disk.
TEST(WorkOnScene, GivesTheSameResultElsewhere) {
  const fs::path top = fs::path(testing::TempDir()) / ("scene_" + std::to_string(::getpid()));
  fs::remove_all(top);
  SceneConfig config;
  config.hand = "tum";
  config.object = "golf_ball";
  config.grasp = "best";
  config.optimise.step = "1";
  config.optimise.choice_trials = 1;
  config.optimise.check_pairs = 20;
  config.sim.step = 0.004;
  config.strategy.hold_time = 0.2;
  LoadSceneInputs(config);
  PlanScene(top / "here", config);
  fs::copy(top / "here", top / "there", fs::copy_options::recursive);
  Observer observer;
  ShardRequest request;
  request.folder = top / "here";
  request.time_budget = 1e-6;  // one trial at least, however fast the machine
  EXPECT_EQ(WorkOnShard(request, observer).num_left, 1);
  EXPECT_FALSE(ReadSearchProgress(top / "here").is_finished);
  request.folder = top / "there";
  request.time_budget = 3600.0;
  EXPECT_EQ(WorkOnShard(request, observer).num_left, 0);
  EXPECT_TRUE(ReadSearchProgress(top / "there").is_finished);
  EXPECT_GT(MergeScenes(top / "here", {top / "there"}), 0);
  EXPECT_EQ(MergeScenes(top / "here", {top / "there"}), 0);
  for (const char* file : {"result.json", "journal.jsonl", "manifest.json", "new-pregrasp.yaml"}) {
    EXPECT_TRUE(ReadFile(top / "here" / file) == ReadFile(top / "there" / file)) << file;
  }
  EXPECT_TRUE(CheckStore(top / "here").damages.empty());
  request.shard = {2, 2};
  EXPECT_THROW(WorkOnShard(request, observer), Error);
  fs::remove_all(top);
}

TEST_F(WorkOnShardTest, RefusesAnotherBuildUnlessAllowed) {
  std::string text = ReadFile(folder_ / "run.json");
  const size_t build = text.find("\"build\": \"") + 10;
  const std::string own = text.substr(build, 16);
  WriteFile(folder_ / "run.json", text.replace(build, 16, "0123456789abcdef"));
  const std::string said = Refuse(ErrorKind::kVersion);
  EXPECT_NE(said.find("build 0123456789abcdef"), std::string::npos) << said;
  EXPECT_NE(said.find("build " + own), std::string::npos) << said;
  request_.allow_build = true;
  EXPECT_EQ(Work().num_left, 0);
}

TEST_F(WorkOnShardTest, RefusesAnotherPhysicsAndPlan) {
  const std::string physics = std::to_string(kPhysicsVersion);
  Forge("session.json", "\"physics_version\": " + physics, "\"physics_version\": 1");
  const std::string said = Refuse(ErrorKind::kVersion);
  EXPECT_NE(said.find("physics version 1, this program has " + physics), std::string::npos) << said;
  Forge("session.json", "\"physics_version\": 1", "\"physics_version\": " + physics);
  const std::string id = LoadSession(folder_).plan[0].id;
  Forge("plan.jsonl", id, "0123456789abcdef");
  const std::string plan = Refuse(ErrorKind::kVersion);
  EXPECT_NE(plan.find("0123456789abcdef"), std::string::npos) << plan;
  EXPECT_NE(plan.find(id), std::string::npos) << plan;
}

TEST_F(WorkOnShardTest, RefusesDamageAndTooManyShards) {
  request_.shard = {1, 100};
  Refuse(ErrorKind::kUsage);
  request_.shard = {1, 2};
  std::string plan = ReadFile(folder_ / "plan.jsonl");
  WriteFile(folder_ / "plan.jsonl", plan.substr(0, plan.find('\n') + 1));
  EXPECT_NE(Refuse(ErrorKind::kFormat).find("plan.jsonl"), std::string::npos);
}

/** Bytes of whole campaigns are compared in tests/cluster. */
class WorkOnCampaignTest : public testing::Test {
 protected:
  WorkOnCampaignTest() {
    config_.session.hands = {"tum"};
    config_.session.objects = {"golf_ball", "tea_light"};
    config_.session.trials = 2;
    CampaignRequest campaign;
    campaign.folder = folder_;
    campaign.config = config_;
    EXPECT_EQ(PlanCampaign(campaign), 2);
    request_.folder = folder_;
    request_.shard = {1, 3};
  }
  ShardResult Work() { return WorkOnShard(request_, observer_); }

  const TemporaryFolder top_;
  const fs::path folder_ = top_.path() / "campaign";
  CampaignConfig config_;
  ShardRequest request_;
  std::atomic<bool> stop_{false};
  Observer observer_{stop_};
};

TEST_F(WorkOnCampaignTest, StopsAndLeavesItsSceneForLater) {
  EXPECT_EQ(CountCards(folder_), 12);
  stop_ = true;
  const ShardResult result = Work();
  EXPECT_EQ(result.num_all, 1);
  EXPECT_EQ(result.num_left, 1);
  EXPECT_TRUE(result.goes_on);
  Diagnostics findings;
  EXPECT_EQ(LoadWorkers(folder_, findings).at_rest, std::set<std::string>{"1of3"});
  stop_ = false;
  request_.shard = {3, 3};  // two scenes only
  EXPECT_EQ(Work().num_all, 0);
  EXPECT_TRUE(CheckStore(folder_).damages.empty());
}

TEST_F(WorkOnCampaignTest, RefusesOtherHandsAndObjects) {
  auto scenes = PlanScenes(config_, LoadSessionInputs(config_.session), folder_);
  scenes[0].inputs.grasp.tilt += 0.1;
  SealScenes(folder_, scenes);
  try {
    Work();
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::kVersion) << error.what();
  }
}

TEST_F(WorkOnCampaignTest, AnUnfinishedOneIsMergedAsItIs) {
  const CampaignRest rest = MergeCampaign(folder_, {});
  EXPECT_EQ(rest.scenes, 2);
  EXPECT_EQ(rest.sum(), 2);
  EXPECT_FALSE(HasSession(folder_ / "benchmark"));
}

}  // namespace

}  // namespace graspbench
