#include "datasets/shards/shard.h"

#include <gtest/gtest.h>

#include <map>
#include <numeric>
#include <set>

#include "core/base/error.h"

namespace graspbench {
namespace {

std::vector<PlannedTrial> MakeTrials(int num_objects, int trials) {
  std::vector<PlannedTrial> plan;
  for (const char* hand : {"tum", "shadow"}) {
    for (int object = 0; object < num_objects; ++object) {
      for (int trial = 0; trial < trials; ++trial) {
        plan.push_back({std::to_string(plan.size()), hand, std::to_string(object), "g1", trial});
      }
    }
  }
  return plan;
}

TEST(ParseShard, TakesPairsFromOneToCountOnly) {
  EXPECT_EQ(ParseShard("3/7").number, 3);
  EXPECT_EQ(ParseShard("3/7").count, 7);
  EXPECT_EQ(ParseShard("1/1").count, 1);
  for (const char* text : {"0/0", "0/7", "8/7", "-1/3", "1/-3", "a/b", "3", "3/", "/7", "3/7 ",
                           " 3/7", "3/7/1", "1.5/3", "+1/3", "99999999999/99999999999", ""}) {
    EXPECT_THROW(ParseShard(text), Error) << text;
  }
}

TEST(PartitionPlan, GivesEveryTrialToOneShardInThePlansOrder) {
  for (const int count : {1, 2, 3, 7, 40, 41, 50, 420}) {
    const std::vector<PlannedTrial> plan = MakeTrials(21, 10);
    std::map<std::string, int> seen;
    for (int number = 1; number <= count; ++number) {
      int last = -1;
      for (const PlannedTrial& planned : PartitionPlan(plan, {number, count})) {
        ++seen[planned.id];
        EXPECT_GT(std::stoi(planned.id), last);
        last = std::stoi(planned.id);
      }
    }
    EXPECT_EQ(seen.size(), plan.size()) << count;
    for (const auto& [id, times] : seen) EXPECT_EQ(times, 1) << id;
  }
}

// Whole groups where they deal out evenly, so that each world is built once.
TEST(PartitionPlan, CutsGroupsOnlyWhereSharesWouldBeUneven) {
  const auto count_worlds = [](int count) {
    int num_worlds = 0;
    size_t largest = 0;
    const std::vector<PlannedTrial> plan = MakeTrials(21, 50);
    for (int number = 1; number <= count; ++number) {
      std::set<std::string> worlds;
      const std::vector<PlannedTrial> trials = PartitionPlan(plan, {number, count});
      for (const PlannedTrial& planned : trials) worlds.insert(planned.hand + planned.object);
      num_worlds += static_cast<int>(worlds.size());
      largest = std::max(largest, trials.size());
    }
    EXPECT_LE(static_cast<double>(largest), 1.2 * 2100 / count) << count;
    return num_worlds;
  };
  EXPECT_EQ(count_worlds(1), 42);
  EXPECT_EQ(count_worlds(7), 42);
  EXPECT_EQ(count_worlds(42), 42);
  EXPECT_EQ(count_worlds(50), 42);  // eight have nothing to do, and no other has more than 50
  EXPECT_GT(count_worlds(40), 42);
}

TEST(PartitionPlan, TakesAsManyShardsAsTrialsAndNoMore) {
  const std::vector<PlannedTrial> plan = MakeTrials(1, 8);
  for (int number = 1; number <= 16; ++number)
    EXPECT_EQ(PartitionPlan(plan, {number, 16}).size(), 1u);
  try {
    PartitionPlan(plan, {1, 100000});
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::kUsage);
    EXPECT_STREQ(error.what(),
                 "100000 shards of 16 trials: expected at most as many shards as trials");
  }
}

TEST(PartitionDraws, KeepsTheTrialsOfADrawTogether) {
  std::vector<PlannedTrial> plan;
  for (const PlannedTrial& draw : MakeTrials(3, 4)) {
    for (int grip = 0; grip < 5; ++grip) {
      plan.push_back(draw);
      plan.back().id += "-" + std::to_string(grip);
    }
  }
  EXPECT_EQ(CountDraws(plan), 24);
  std::map<std::string, int> shards;  // of a draw
  size_t num_trials = 0;
  for (int number = 1; number <= 7; ++number) {
    for (const PlannedTrial& planned : PartitionDraws(plan, {number, 7})) {
      ++num_trials;
      const std::string draw = planned.hand + planned.object + std::to_string(planned.trial);
      EXPECT_EQ(shards.emplace(draw, number).first->second, number) << draw;
    }
  }
  EXPECT_EQ(num_trials, plan.size());
  EXPECT_THROW(PartitionDraws(plan, {1, 25}), Error);
}

TEST(ListSentinels, AreThreeOfAllHands) {
  const std::vector<PlannedTrial> sentinels = ListSentinels(MakeTrials(21, 10));
  ASSERT_EQ(sentinels.size(), 3u);
  EXPECT_EQ(sentinels[0].hand, "tum");
  EXPECT_EQ(sentinels[1].hand, "shadow");
  EXPECT_EQ(sentinels[2].id, "1");
  EXPECT_EQ(ListSentinels(MakeTrials(1, 1)).size(), 2u);
}

}  // namespace
}  // namespace graspbench
