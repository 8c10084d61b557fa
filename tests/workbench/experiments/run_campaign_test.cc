#include "workbench/experiments/run_campaign.h"

#include <gtest/gtest.h>

#include "datasets/campaign/campaign_store.h"
#include "datasets/shards/worker_log.h"
#include "tests/datasets/session/fake_session.h"

namespace graspbench {
namespace {

// Whether they worked on scenes or on the benchmark.
TEST(DescribeCampaignMachines, ComparesAllOfThem) {
  const TemporaryFolder folder;
  CreateCampaign(folder.path(), CampaignConfig());
  const std::vector<PlannedTrial> plan = CreateFakeSession(folder.path() / "benchmark", 2);
  const auto start = [&](const char* host, double height) {
    TrialRecord record = MakeFakeRecord(plan[0]);
    record.result.lift_height = height;
    return WorkerStart{"1of2", "", {host, "", "", "", "", ""}, {record}};
  };
  WorkerLog(folder.path(), "1of2").Append(start("node1", 0.25));
  WorkerLog(folder.path() / "benchmark", "1of2").Append(start("node2", 0.25));
  EXPECT_TRUE(DescribeCampaignMachines(folder.path()).empty());
  WorkerLog(folder.path() / "benchmark", "2of2").Append(start("node3", 0.5));
  const std::vector<std::string> said = DescribeCampaignMachines(folder.path());
  ASSERT_EQ(said.size(), 1u);
  EXPECT_EQ(said[0].rfind("node3 (", 0), 0u) << said[0];
  WorkerLog(folder.path(), "2of2")
      .Append(WorkerStart{"2of2", "", {"node4", "", "", "", "", ""}, {}});
  EXPECT_EQ(DescribeCampaignMachines(folder.path()).size(), 2u);
}

}  // namespace
}  // namespace graspbench
