#include "datasets/campaign/campaign_store.h"

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/base/files/files.h"
#include "datasets/shards/worker_log.h"
#include "tests/datasets/campaign/fake_scene.h"
#include "tests/datasets/find_error.h"
#include "tests/datasets/session/fake_session.h"

namespace graspbench {

namespace {
namespace fs = std::filesystem;

CampaignConfig MakeConfig() {
  CampaignConfig config;
  config.comparison.scenes = {"tum/mug", "shadow/pencil"};
  config.comparison.methods = {"es", "grid"};
  config.comparison.seeds = 2;
  return config;
}

TEST(CampaignConfig, TellsAllProblems) {
  CampaignConfig config = MakeConfig();
  config.session.trials = 0;
  config.session.grasps = {"g1"};
  config.optimise.method = "swarm";
  config.comparison.scenes = {"mug"};
  try {
    CheckCampaignConfig(config);
    FAIL();
  } catch (const Error& e) {
    EXPECT_EQ(std::string(e.what()),
              "the campaign cannot be run\n"
              "session.trials: 0 is out of range; expected 1 to 100000\n"
              "session.grasps: a campaign optimises each object's best grasp; expected \"best\"\n"
              "optimise.method: \"swarm\" is not known. Known: es, cmaes, de, random, grid\n"
              "comparison.scenes: \"mug\": expected hand/object");
  }
}

TEST(CampaignStore, IsContinuedOnlyWithItsOwnSettings) {
  const TemporaryFolder folder;
  CampaignConfig config = MakeConfig();
  EXPECT_FALSE(HasCampaign(folder.path()));
  CreateCampaign(folder.path(), config);
  CreateCampaign(folder.path(), config);
  EXPECT_EQ(LoadCampaign(folder.path()).config.comparison.scenes, config.comparison.scenes);
  config.optimise.evaluations = 77;
  EXPECT_TRUE(Throws([&] { CreateCampaign(folder.path(), config); }, ErrorKind::kUsage,
                     "optimise.evaluations"));
}

TEST(CampaignStore, PlansOneSceneForEachHandAndObject) {
  const auto scenes = PlanScenes(MakeConfig(), MakeFakeInputs(), "c");
  ASSERT_EQ(scenes.size(), 4u);
  EXPECT_EQ(scenes[0].folder, fs::path("c/scenes/tum-mug"));
  EXPECT_EQ(scenes[0].config.grasp, "g2");
  EXPECT_EQ(scenes[3].folder, fs::path("c/scenes/shadow-pencil"));
}

TEST(CampaignStore, ScenesOfOneFolderAreRefused) {
  SessionInputs inputs = MakeFakeInputs();
  const char* const object_ids[] = {"b-mug", "mug"};
  const char* const hand_ids[] = {"a", "a-b"};
  for (size_t i = 0; i < 2; ++i) {
    auto object = std::make_shared<GraspObject>(*inputs.objects[i]);
    object->id = object_ids[i];
    object->best_grasp = {{"a", "g2"}, {"a-b", "g2"}};
    inputs.objects[i] = object;
    auto hand = std::make_shared<Hand>(*inputs.hands[i].hand);
    hand->id = hand_ids[i];
    inputs.hands[i].hand = hand;
  }
  EXPECT_TRUE(Has(FindError([&] { PlanScenes(MakeConfig(), inputs, "c"); }),
                  "come to the same folder a-b-mug"));
}

// Machines that load other hands or objects than the one that planned are told.
TEST(CampaignStore, KnowsWhetherScenesAreThosePlanned) {
  const TemporaryFolder folder;
  const CampaignConfig config = MakeConfig();
  CreateCampaign(folder.path(), config);
  auto scenes = PlanScenes(config, MakeFakeInputs(), folder.path());
  CheckSameScenes(folder.path(), scenes);  // nothing is said of them yet
  SealScenes(folder.path(), scenes);
  CheckSameScenes(folder.path(), scenes);
  scenes[0].inputs.grasp.tilt += 1e-9;
  EXPECT_THROW(CheckSameScenes(folder.path(), scenes), Error);
  EXPECT_EQ(LoadCampaignConfig(folder.path()).comparison.seeds, 2);
  EXPECT_EQ(FindSceneNumber(scenes, scenes[0]), 2u);  // shadow-mug, shadow-pencil, tum-mug, ..
  EXPECT_TRUE(ListScenes(folder.path()).empty());
}

TEST(CampaignStore, CountsTheEvaluationsToNinetyPercentOfTheBestOfTheScene) {
  const TemporaryFolder folder;
  CampaignConfig config = MakeConfig();
  CreateCampaign(folder.path(), config);
  const fs::path mug = folder.path() / "comparison" / "tum-mug";
  WriteSearch(mug / "es-1.jsonl", {1.0, 1.5, 1.95, 2.0});
  WriteSearch(mug / "es-2.jsonl", {1.0, 1.2, 1.1});
  WriteSearch(mug / "grid-1.jsonl", {1.0, 1.9});
  const Campaign campaign = LoadCampaign(folder.path());
  ASSERT_EQ(campaign.comparison.size(), 3u);
  EXPECT_EQ(campaign.comparison[0].fitness, (std::vector<double>{1.0, 1.5, 1.95, 2.0}));
  EXPECT_EQ(campaign.comparison[0].evaluations_to_90, 3);  // 1.9 is 90 % of the way to 2
  EXPECT_EQ(campaign.comparison[1].evaluations_to_90, 0);
  EXPECT_EQ(campaign.comparison[2].evaluations_to_90, 2);
}

class MergeCampaignsTest : public testing::Test {
 protected:
  fs::path MakeScene(const std::string& name, const std::vector<double>& fitness,
                     bool is_finished = false) {
    WriteScene(top_.path() / name, "can", fitness, is_finished);
    return top_.path() / name;
  }
  /** Two scenes, of which `finished` is; "can" and "mug". */
  fs::path MakeCampaign(const std::string& name, const std::string& finished) {
    const fs::path folder = top_.path() / name;
    CreateCampaign(folder, CampaignConfig());
    for (const char* object : {"can", "mug"}) {
      WriteScene(folder / "scenes" / ("tum-" + std::string(object)), object, {1.0, 2.0},
                 object == finished);
    }
    SealStore(kCampaignStore, folder);
    return folder;
  }
  TemporaryFolder top_;
};

TEST_F(MergeCampaignsTest, TheLongerJournalAndTheResultAreTaken) {
  const fs::path a = MakeScene("a", {1.0, 2.0}), b = MakeScene("b", {1.0, 2.0, 3.0}, true);
  EXPECT_EQ(MergeScenes(b, {a}), 0);
  EXPECT_EQ(MergeScenes(a, {b}), 1);
  EXPECT_TRUE(HasSceneResult(a));
  for (const char* file : {"journal.jsonl", "result.json", "manifest.json"}) {
    EXPECT_EQ(ReadFile(a / file), ReadFile(b / file)) << file;
  }
  EXPECT_EQ(MergeScenes(a, {b}), 0);
  EXPECT_TRUE(CheckStore(a).damages.empty());
}

TEST_F(MergeCampaignsTest, OtherAnswersAndOtherSettingsAreRefused) {
  const fs::path a = MakeScene("a", {1.0, 2.0}), b = MakeScene("b", {1.0, 2.5, 3.0});
  const std::string before = ReadFile(a / "journal.jsonl");
  EXPECT_THROW(MergeScenes(a, {b}), Error);
  WriteScene(top_.path() / "c", "mug", {1.0, 2.0, 3.0}, false);
  EXPECT_THROW(MergeScenes(a, {top_.path() / "c"}), Error);
  EXPECT_THROW(MergeScenes(a, {top_.path() / "none"}), Error);
  EXPECT_EQ(ReadFile(a / "journal.jsonl"), before);
}

TEST_F(MergeCampaignsTest, ATornEndIsNoAnswer) {
  const fs::path a = MakeScene("a", {1.0, 2.0}), b = MakeScene("b", {1.0, 2.0, 3.0});
  const std::string text = ReadFile(b / "journal.jsonl");
  WriteFile(b / "journal.jsonl", text.substr(0, text.size() - 5));
  EXPECT_EQ(MergeScenes(a, {b}), 0);
  EXPECT_EQ(MergeScenes(b, {a}), 0);
}

TEST_F(MergeCampaignsTest, ScenesSearchesAndWorkersComeTogether) {
  const fs::path a = MakeCampaign("a", "can"), b = MakeCampaign("b", "mug");
  WriteSearch(b / "comparison" / "tum-can" / "es-1.jsonl", {1.0, 2.0, 3.0});
  WorkerLog(b, "2of2").Append(WorkerStart{"2of2", "2026-01-31T12:00:00Z", {}, {}});
  EXPECT_EQ(MergeCampaigns(a, {b}), 3);
  EXPECT_EQ(MergeCampaigns(a, {b}), 0);
  for (const fs::path& scene : ListScenes(a)) EXPECT_TRUE(HasSceneResult(scene)) << scene;
  Diagnostics findings;
  EXPECT_EQ(LoadWorkers(a, findings).starts.size(), 1u);
  EXPECT_TRUE(CheckStore(a).damages.empty());
  CampaignConfig other;
  other.session.seed = 2;
  CreateCampaign(top_.path() / "c", other);
  EXPECT_THROW(MergeCampaigns(a, {top_.path() / "c"}), Error);
}

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
