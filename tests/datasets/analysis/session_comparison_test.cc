#include "datasets/analysis/session_comparison.h"

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "tests/datasets/analysis/made_results.h"

namespace graspbench {
namespace {

std::string FindMessage(const Session& before, const Session& after) {
  try {
    CompareSessions(before, after);
  } catch (const Error& e) {
    return e.what();
  }
  return "";
}

TEST(SessionComparison, TrialsWonAndLostAreThoseThatChanged) {
  Session before = MakeSession({"tum", "shadow"}, {"can", "cup"}, "g3", 3), after = before;
  for (size_t i = 0; i < after.plan.size(); ++i) {  // of another physics
    after.plan[i].id += "x";
    after.records[i].plan = after.plan[i];
  }
  before.records[1].result.outcome = Outcome::kPushedAway;
  before.records[2].result.outcome = after.records[2].result.outcome = Outcome::kNoContact;
  after.records[7].result.outcome = Outcome::kKnockedOver;
  after.config.sim.step = 0.001;
  const SessionComparison comparison = CompareSessions(before, after);
  ASSERT_EQ(comparison.pairs.size(), 12u);
  for (size_t i = 0; i < 12; ++i) {
    EXPECT_EQ(comparison.pairs[i].before, &before.records[i]);
    EXPECT_EQ(comparison.pairs[i].after, &after.records[i]);
    EXPECT_EQ(comparison.pairs[i].is_won(), i == 1);
    EXPECT_EQ(comparison.pairs[i].is_lost(), i == 7);
  }
  ASSERT_EQ(comparison.changes.size(), 2u);
  EXPECT_EQ(comparison.changes[0].hand, "tum");
  EXPECT_EQ(comparison.changes[0].successes.second_only, 1);
  EXPECT_EQ(comparison.changes[0].successes.neither, 1);
  EXPECT_EQ(comparison.changes[0].successes.both, 4);
  EXPECT_EQ(comparison.changes[1].successes.first_only, 1);
  EXPECT_EQ(comparison.settings, (std::vector<std::string>{"sim.step_s: 0.002 and 0.001"}));
}

TEST(SessionComparison, WhatIsInOneOnlyIsCounted) {
  const Session before = MakeSession({"tum"}, {"can", "cup"}, "g3", 3);
  const Session after = MakeSession({"tum"}, {"cup", "pencil", "ball"}, "g3", 2);
  const SessionComparison comparison = CompareSessions(before, after);
  EXPECT_EQ(comparison.pairs.size(), 2u);
  EXPECT_EQ(comparison.num_only_before, 4);
  EXPECT_EQ(comparison.num_only_after, 4);
}

TEST(SessionComparison, OneHandOrGraspEachMayBeOthers) {
  const Session before = MakeSession({"tum"}, {"can"}, "g3", 3);
  EXPECT_EQ(CompareSessions(before, MakeSession({"mine"}, {"can"}, "g1", 3)).pairs.size(), 3u);
  // With two hands on one side nobody knows which of them is meant.
  EXPECT_EQ(CompareSessions(before, MakeSession({"mine", "tum"}, {"can"}, "g3", 3)).pairs.size(),
            3u);
  EXPECT_NE(FindMessage(before, MakeSession({"mine", "other"}, {"can"}, "g3", 3)), "");
}

TEST(SessionComparison, OtherDrawsAreNoPairs) {
  const Session before = MakeSession({"tum"}, {"can"}, "g3", 3);
  Session after = before;
  after.config.seed = 2;
  EXPECT_NE(FindMessage(before, after).find("they have different seeds: 1 and 2"),
            std::string::npos);
  after = before;
  after.config.variation.offset = 0.01;
  EXPECT_NE(FindMessage(before, after).find("variation.offset_m"), std::string::npos);
  after.records.clear();
  EXPECT_NE(FindMessage(before, after).find("no finished trial"), std::string::npos);
  EXPECT_NE(FindMessage(before, MakeSession({"tum"}, {"cup"}, "g3", 3)).find("in common"),
            std::string::npos);
}

}  // namespace
}  // namespace graspbench
