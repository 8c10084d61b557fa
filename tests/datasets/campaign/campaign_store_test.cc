#include "datasets/campaign/campaign_store.h"

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/base/files/files.h"
#include "tests/datasets/campaign/fake_scene.h"
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
  try {
    CreateCampaign(folder.path(), config);
    FAIL();
  } catch (const Error& e) {
    EXPECT_EQ(e.kind(), ErrorKind::kUsage);
    EXPECT_NE(std::string(e.what()).find("optimise.evaluations"), std::string::npos) << e.what();
  }
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
  try {
    PlanScenes(MakeConfig(), inputs, "c");
    FAIL();
  } catch (const Error& e) {
    EXPECT_NE(std::string(e.what()).find("come to the same folder a-b-mug"), std::string::npos)
        << e.what();
  }
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

}  // namespace
}  // namespace graspbench
