#include "datasets/analysis/controller_comparison.h"

#include <gtest/gtest.h>

#include "tests/datasets/analysis/made_results.h"

namespace graspbench {
namespace {

std::vector<std::string> NameObjects(int count) {
  std::vector<std::string> names;
  for (int i = 0; i < count; ++i) names.push_back("object" + std::to_string(i));
  return names;
}

TEST(ControllerComparison, CountsByObjectWhatNeitherHolds) {
  Session before = MakeSession({"tum"}, {"can", "cup"}, "g3", 3), after = before;
  before.records[0].result.outcome = Outcome::kPushedAway;  // fails in both
  after.records[0].result.outcome = Outcome::kNoContact;
  after.records[4].result.outcome = Outcome::kKnockedOver;
  const auto objects = CompareObjects(CompareSessions(before, after).pairs);
  ASSERT_EQ(objects.size(), 2u);
  EXPECT_EQ(objects[0].object, "can");
  EXPECT_EQ(objects[0].successes.neither, 1);
  EXPECT_EQ(objects[0].successes.both, 2);
  EXPECT_EQ(objects[1].successes.first_only, 1);
  const Json rows = MakeJsonRows(ListObjectComparisonColumns(), objects);
  EXPECT_EQ(rows[0]["failed_first"], 1);
  EXPECT_EQ(rows[1]["failed_second"], 1);
  EXPECT_EQ(rows[0]["failed_both"], 1);
}

// One draw lost on each of 6 objects: all of 2^6 signs but two have a smaller sum.
TEST(ControllerComparison, DecidesByObject) {
  Session before = MakeSession({"tum"}, NameObjects(6), "g3", 3), after = before;
  for (size_t i = 0; i < 6; ++i) after.records[3 * i].result.outcome = Outcome::kPushedAway;
  const auto decisions = DecideByObject(CompareObjects(CompareSessions(before, after).pairs));
  ASSERT_EQ(decisions.size(), 1u);
  EXPECT_EQ(decisions[0].num_objects, 6);
  EXPECT_DOUBLE_EQ(decisions[0].p, 2.0 / 64.0);
  EXPECT_EQ(decisions[0].successes.first_only, 6);
  EXPECT_TRUE(decisions[0].num_pairs_needed);
}

TEST(ControllerComparison, ComparesBreakingForcesOfWhatWasJudgedInBoth) {
  Session before = MakeSession({"tum"}, {"can"}, "g3", 3), after = before;
  EXPECT_TRUE(CompareLoads(CompareSessions(before, after).pairs).empty());
  const auto judge = [](TrialRecord& record, double force) {
    record.judgement.emplace();
    record.judgement->breaking_force = force;
  };
  for (size_t i = 0; i < 3; ++i) judge(before.records[i], 2.0);
  judge(after.records[0], 3.0);
  judge(after.records[2], 4.0);
  const auto loads = CompareLoads(CompareSessions(before, after).pairs);
  ASSERT_EQ(loads.size(), 1u);
  EXPECT_EQ(loads[0].num_pairs, 2);
  EXPECT_DOUBLE_EQ(loads[0].before, 2.0);
  EXPECT_DOUBLE_EQ(loads[0].after, 3.5);
  EXPECT_DOUBLE_EQ(loads[0].ratio, 1.75);
}

TEST(ControllerComparison, ALearningCurveIsAgainstItsFirstSession) {
  Session first = MakeSession({"tum"}, {"can"}, "g3", 4), second = first;
  first.records[0].result.outcome = first.records[1].result.outcome = Outcome::kPushedAway;
  second.records[1].result.outcome = Outcome::kPushedAway;
  Session other = MakeSession({"tum"}, {"can"}, "g3", 4);
  other.config.seed += 1;
  const auto points = ListLearningPoints({{"0", &first}, {"1", &second}, {"2", &other}});
  ASSERT_EQ(points.size(), 3u);
  EXPECT_DOUBLE_EQ(points[0].rate, 0.5);
  EXPECT_EQ(points[0].num_pairs, 0);
  EXPECT_DOUBLE_EQ(points[1].rate, 0.75);
  EXPECT_EQ(points[1].num_pairs, 4);
  EXPECT_DOUBLE_EQ(points[1].change, 0.25);
  EXPECT_EQ(points[2].num_pairs, 0) << "another seed: no draw in common";
}

}  // namespace
}  // namespace graspbench
