#include "datasets/judged_grasps/grasp_store.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/error.h"
#include "core/base/files/files.h"
#include "tests/datasets/find_error.h"
#include "tests/datasets/session/fake_session.h"

namespace graspbench {

namespace {

namespace fs = std::filesystem;

JudgedGrasp MakeJudged(int request) {
  JudgedGrasp judged;
  judged.request = request;
  judged.source = "a.npy";
  judged.index = request;
  judged.object = "=mug";
  judged.profile = "own";
  judged.label = "success";
  judged.result.passed = request % 2 == 0;
  judged.result.worst_shift = 0.1 * request;
  judged.result.failed_stage = judged.result.passed ? "" : "push +x";
  return judged;
}

const Json kConfig = {{"hand", "shadow"}, {"jitter", 0}};

TEST(GraspStore, WhatWasJudgedIsReadAgain) {
  const TemporaryFolder folder;
  CreateJudgedGrasps(folder.path(), kConfig);
  EXPECT_TRUE(HasJudgedGrasps(folder.path()));
  {
    GraspJournal journal(folder.path() / "journal.jsonl");
    journal.Append({MakeJudged(0), MakeJudged(1)});
  }
  const std::vector<JudgedGrasp> judged = LoadJudgedGrasps(folder.path());
  ASSERT_EQ(judged.size(), 2u);
  for (int i = 0; i < 2; ++i) {
    JudgedGrasp expected = MakeJudged(i);
    expected.search = judged[static_cast<size_t>(i)].search;
    EXPECT_EQ(JudgedGrasp::Format(judged[static_cast<size_t>(i)]), JudgedGrasp::Format(expected));
  }
  FinishJudgedGrasps(folder.path(), judged);
  const std::string table = ReadFile(folder.path() / "grasps.csv");
  EXPECT_TRUE(Has(table, "'=mug,own,0,success,1,"));
  EXPECT_TRUE(CheckStore(folder.path()).damages.empty());
}

TEST(GraspStore, AnotherRequestIsRefused) {
  const TemporaryFolder folder;
  CreateJudgedGrasps(folder.path(), kConfig);
  EXPECT_NO_THROW(CheckSameGrasps(folder.path(), kConfig));
  EXPECT_TRUE(Has(FindError([&] {
                    CheckSameGrasps(folder.path(), {{"hand", "tum"}, {"jitter", 0}});
                  }),
                  "hand"));
}

JudgedGrasp MakeJudged(int index, const std::string& profile, bool passed, bool label, double shift,
                       int jitter = 0) {
  JudgedGrasp judged;
  judged.source = "a.npy";
  judged.index = index;
  judged.profile = profile;
  judged.jitter = jitter;
  judged.label = label ? "success" : "failure";
  judged.result.passed = passed;
  judged.result.failed_stage = passed ? "" : "push +x";
  judged.result.worst_shift = shift;
  return judged;
}

const std::map<std::string, std::pair<double, double>> kLimits = {{"a", {0.05, 15.0}},
                                                                  {"b", {0.05, 15.0}}};

// Two judges, 50 cases: both say yes 20 times, one only 5, the other only 10, none 15 (the worked
// example of many textbooks): p_o = 0.7, p_e = 0.5, kappa = 0.4.
TEST(JudgedSummary, KappaOfAKnownTable) {
  EXPECT_NEAR(CalcKappa({20, 5, 10, 15}), 0.4, 1e-12);
  EXPECT_NEAR(CalcKappa({7, 0, 0, 3}), 1.0, 1e-12);
  EXPECT_TRUE(std::isnan(CalcKappa({5, 0, 0, 0})));
}

TEST(JudgedSummary, CountsByProfile) {
  const std::vector<JudgedGrasp> judged = {
      MakeJudged(0, "a", true, true, 0.01),    MakeJudged(0, "b", false, true, 0.06),
      MakeJudged(1, "a", true, false, 0.049),  MakeJudged(1, "b", true, false, 0.02),
      MakeJudged(2, "a", false, false, 0.3),   MakeJudged(2, "b", false, false, 0.3),
      MakeJudged(0, "a", true, true, 0.01, 1), MakeJudged(0, "a", false, true, 0.2, 2),
      MakeJudged(2, "a", true, false, 0.01, 1)};  // of a failure: not counted
  const JudgedSummary summary = SummariseJudged(judged, kLimits);
  EXPECT_EQ(summary.num_grasps, 3);
  ASSERT_EQ(summary.profiles.size(), 2u);
  EXPECT_EQ(summary.profiles[0].num_passed, 2);
  EXPECT_EQ(summary.profiles[1].num_passed, 1);
  EXPECT_EQ(summary.profiles[0].labels.both, 1);
  EXPECT_EQ(summary.profiles[0].labels.second_only, 1);
  EXPECT_EQ(summary.profiles[0].labels.neither, 1);
  EXPECT_DOUBLE_EQ(summary.profiles[0].jitter_share, 0.5);
  EXPECT_TRUE(std::isnan(summary.profiles[1].jitter_share));
  ASSERT_EQ(summary.transitions.size(), 1u);
  EXPECT_EQ(summary.transitions[0].counts.both, 1);
  EXPECT_EQ(summary.transitions[0].counts.first_only, 1);
  EXPECT_EQ(summary.transitions[0].counts.neither, 1);
  ASSERT_EQ(summary.nearest.size(), 6u);
  EXPECT_EQ(summary.nearest[0], &judged[2]) << "49 of 50 mm";
  EXPECT_EQ(summary.nearest[1], &judged[1]) << "60 of 50 mm";
}

TEST(JudgedSummary, LimitsComeFromTheFrozenProfiles) {
  const Json config = {
      {"profiles", {{{"name", "a"}, {"values", {{"max_shift_m", 0.3}, {"max_turn_deg", 90.0}}}}}}};
  EXPECT_EQ(FindLimits(config).at("a"), std::make_pair(0.3, 90.0));
  EXPECT_THROW(FindLimits(Json::object()), Error);
}

}  // namespace

}  // namespace graspbench
