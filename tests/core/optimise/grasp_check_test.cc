#include "core/optimise/grasp_check.h"

#include <gtest/gtest.h>

#include <set>

namespace graspbench {
namespace {

/** The new grasp loses the object in every n-th draw; its sigma is higher by `gain`. */
struct MadeTrials {
  int new_loses_every = 0;
  double gain = 0.0;
  bool nothing_holds = false;
  std::vector<LearningRequest> asked;

  RunLearningTrials MakeRun() {
    return [this](const std::vector<LearningRequest>& requests) {
      std::vector<std::vector<LearningTrial>> answers;
      for (const LearningRequest& request : requests) {
        asked.push_back(request);
        answers.emplace_back();
        for (const int draw : request.draws) {
          LearningTrial& trial = answers.back().emplace_back();
          const bool is_new = request.grasp.id == "new";
          trial.draw = draw;
          trial.sigma = 1.0 + 0.01 * (draw % 7) + (is_new ? gain : 0.0);
          const bool is_lost = is_new && new_loses_every > 0 && draw % new_loses_every == 0;
          trial.outcome = is_lost || nothing_holds ? Outcome::kSlippedInLiftOff : Outcome::kSuccess;
        }
      }
      return answers;
    };
  }
};

GraspCheck Check(MadeTrials& trials, int most_pairs = 100) {
  Grasp before, after;
  before.id = "old";
  after.id = "new";
  return CheckGrasp(before, after,
                    {5000, most_pairs, [](const LearningTrial& trial) { return trial.sigma; }},
                    trials.MakeRun());
}

TEST(GraspCheck, TriesBothOnTheSameFreshDrawsUntilItIsShown) {
  MadeTrials trials;
  trials.gain = 0.1;
  const GraspCheck check = Check(trials);
  EXPECT_TRUE(check.is_taken());
  ASSERT_EQ(check.before.size(), 80u);  // paired_decision_test: nothing lost is shown at 80
  std::set<int> draws;
  for (size_t i = 0; i < check.before.size(); ++i) {
    EXPECT_EQ(check.before[i].draw, check.after[i].draw);
    draws.insert(check.before[i].draw);
  }
  EXPECT_EQ(draws.size(), 80u);
  EXPECT_EQ(*draws.begin(), 5000);
  EXPECT_EQ(DescribeRefusal(check, "start", "it", "no"), "");
}

// A heavy object that nothing lifts: lost later is no better grasp.
TEST(GraspCheck, WhatHoldsInNoTrialIsNotTaken) {
  MadeTrials trials;
  trials.gain = 0.1;
  trials.nothing_holds = true;
  const GraspCheck check = Check(trials);
  EXPECT_FALSE(check.is_taken());
  EXPECT_EQ(DescribeRefusal(check, "start", "the new target", "no"),
            "start kept: the new target held in none of 80 trials");
}

TEST(GraspCheck, GivesUpAtTheFirstLook) {
  MadeTrials trials;
  trials.gain = 0.1;
  trials.new_loses_every = 3;
  GraspCheck check = Check(trials);
  EXPECT_EQ(check.before.size(), 20u);
  EXPECT_EQ(DescribeRefusal(check, "start", "the new target", "no"),
            "start kept: the new target succeeded less often");
  trials = {};
  check = Check(trials);
  EXPECT_EQ(check.before.size(), 20u);
  EXPECT_EQ(DescribeRefusal(check, "start", "it", "sigma was the same"),
            "start kept: sigma was the same");
}

TEST(GraspCheck, SaysWhenThePairsWereTooFew) {
  MadeTrials trials;
  trials.gain = 0.1;
  const GraspCheck check = Check(trials, 40);
  EXPECT_FALSE(check.is_taken());
  EXPECT_EQ(DescribeRefusal(check, "start", "it", "no"),
            "start kept: not decided after 40 pairs of trials");
}

}  // namespace
}  // namespace graspbench
