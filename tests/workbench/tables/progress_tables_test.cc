#include "workbench/tables/progress_tables.h"

#include <gtest/gtest.h>

#include "tests/datasets/session/fake_session.h"

namespace graspbench {

namespace {

SessionProgress MakeProgress() {
  SessionProgress progress;
  progress.num_trials = 7;
  progress.num_finished = 4;
  progress.shards = {{{1, 2}, 4, 4, 3.0, ShardState::kFinished},
                     {{2, 2}, 3, 0, std::nullopt, ShardState::kWaiting}};
  return progress;
}

TEST(MakeStatusJson, SaysWhatNobodyHasBegun) {
  const Json json = MakeStatusJson(MakeProgress());
  EXPECT_EQ(json["shards"][0]["age_s"], 3.0);
  EXPECT_TRUE(json["shards"][1]["age_s"].is_null());
  EXPECT_TRUE(json["judge"].is_null());
  CampaignProgress campaign;
  EXPECT_TRUE(MakeStatusJson(campaign)["benchmark"].is_null());
  campaign.benchmark = MakeProgress();
  campaign.benchmark->judge = JudgeProgress{5, 2, {}};
  EXPECT_EQ(MakeStatusJson(campaign)["benchmark"]["judge"]["held_grasps"], 5);
}

TEST(MachineTables, ListsWhoHasWorkedOnWhat) {
  const TemporaryFolder folder;
  EXPECT_TRUE(FormatMachines(ListMachines(folder.path())).empty());
  const Machine one = {"node1", "a processor", "flags", "glibc 2.36", "build1", "0.1.0"};
  Machine two = one;
  two.host = "node2";
  two.build = "build2";
  WorkerLog first(folder.path(), "1of3"), second(folder.path(), "2of3"),
      third(folder.path(), "3of3");
  first.Append(WorkerStart{"1of3", "", one, {}});
  first.Append(WorkerStart{"1of3", "", one, {}});
  second.Append(WorkerStart{"2of3", "", one, {}});
  second.Append(WorkerStart{"2of3", "", two, {}});
  third.Append(WorkerStart{"3of3", "", {}, {}});  // brought by a merge, machine unknown
  const std::vector<MachineShards> machines = ListMachines(folder.path());
  ASSERT_EQ(machines.size(), 2u);
  EXPECT_EQ(CountBuilds(machines), 2u);
  EXPECT_EQ(machines[0].shards.size(), 2u);
  EXPECT_EQ(FormatMachines(machines),
            "machine  processor    C library   build   shards\n"
            "node1    a processor  glibc 2.36  build1       2\n"
            "node2    a processor  glibc 2.36  build2       1\n\n");
  EXPECT_EQ(MakeMachinesJson(machines)[1]["shards"], Json::array({"2of3"}));
}

}  // namespace

}  // namespace graspbench
