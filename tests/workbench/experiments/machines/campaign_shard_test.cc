#include "workbench/experiments/machines/campaign_shard.h"

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "datasets/campaign/campaign_store.h"
#include "tests/datasets/session/fake_session.h"
#include "workbench/experiments/machines/merge_campaign.h"
#include "workbench/experiments/run_campaign.h"

namespace graspbench {
namespace {
namespace fs = std::filesystem;

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
  ShardResult Work() { return WorkOnCampaign(request_, observer_, stop_); }

  const TemporaryFolder top_;
  const fs::path folder_ = top_.path() / "campaign";
  CampaignConfig config_;
  ShardRequest request_;
  Observer observer_;
  std::atomic<bool> stop_{false};
};

TEST_F(WorkOnCampaignTest, StopsAndLeavesItsSceneForLater) {
  EXPECT_EQ(CountCampaignCards(folder_), 12);
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
