#include "core/trial/remedies.h"

#include <gtest/gtest.h>

#include "tests/core/trial/trial_setups.h"

namespace graspbench {
namespace {

const RemedyResult& Find(const Explanation& explanation, const std::string& id) {
  static const RemedyResult none{"none"};
  for (const RemedyResult& remedy : explanation.remedies) {
    if (remedy.id == id) return remedy;
  }
  ADD_FAILURE() << id;
  return none;
}

FailedTrial Fail(const TrialSetup& setup, TrialRunner& runner) {
  FailedTrial failed{setup, runner.Run(setup), {}, {}};
  EXPECT_FALSE(IsSuccess(failed.result.outcome));
  for (int i = 0; i < kNumFreshDraws; ++i) {
    failed.fresh.push_back(setup.draw);
    failed.fresh.back().offset_x = 1e-4 * i;
  }
  return failed;
}

// Coulomb: two digits bear 2 mu N. 0.98 N with mu = 0.2 ask for 2.45 N each: 0.7 N and twice it are
// too little, four times it are enough. Half the mass asks for 1.23 N, twice the friction likewise.
TEST(Remedies, OfTooLittleGripTheOneThatCoulombAsksForHolds) {
  TrialSetup setup = MakeSetup("tum-evolved", "g2", MakeCube(0.1, 0.2));
  setup.strategy.grip = "force";
  setup.strategy.touch_speed = 0.25;
  TrialRunner runner(setup.hand, setup.object);
  const FailedTrial failed = Fail(setup, runner);
  const Explanation found = ExplainFailure(runner, failed);
  EXPECT_FALSE(found.is_on_edge);
  EXPECT_EQ(found.num_held(), 0);
  EXPECT_FALSE(Find(found, "grip-x2").holds);
  EXPECT_TRUE(Find(found, "grip-x4").holds);
  EXPECT_EQ(Find(found, "grip-x4").num_mended, kNumFreshDraws);
  EXPECT_LT(Find(found, "grip-x2").num_draws, kNumFreshDraws) << "nothing gained, not the best";
  EXPECT_FALSE(Find(found, "half-mass").holds);
  EXPECT_FALSE(Find(found, "no-offset").holds);
  for (const RemedyResult& remedy : found.remedies) EXPECT_NE(remedy.id, "friction-x2");
  ASSERT_TRUE(found.FindBest(false));
  EXPECT_EQ(found.FindBest(true), nullptr) << "no other grasp was tried";
  EXPECT_EQ(RecordToJson(found), RecordToJson(ExplainFailure(runner, failed))) << "same bytes";

  const Explanation few = ExplainFailure(runner, failed, ExplainDepth::kShort);
  EXPECT_TRUE(few.is_short() && !found.is_short());
  EXPECT_EQ(few.num_draws(), kNumFirstDraws);
  EXPECT_EQ(Find(few, "grip-x4").num_mended, kNumFirstDraws);
  for (const RemedyResult& remedy : few.remedies) EXPECT_EQ(remedy.num_draws, kNumFirstDraws);
  ASSERT_TRUE(few.FindBest(false));
  EXPECT_EQ(SummariseExplanation(few),
            "four times the grip (strategy.grip_margin and grip_force_n times 4): 4 of 4");
}

TEST(Remedies, OnlyOnesOfAllDrawsWithEnoughGainAreNamed) {
  Explanation found;
  found.held.assign(kNumFreshDraws, 0);
  found.held[0] = 1;
  found.remedies = {{"grip-x2", true, kNumFirstDraws, 4, 0},
                    {"slower", true, kNumFreshDraws, 4, 1},
                    {"no-offset", true}};
  EXPECT_EQ(found.FindBest(false), nullptr);
  EXPECT_NE(DescribeExplanation(found).find("No tested remedy gains 4"), std::string::npos);
  EXPECT_NE(DescribeExplanation(found).find("For diagnosis: this draw also holds with no offset"),
            std::string::npos);
  found.remedies.push_back({"lower", false, kNumFreshDraws, 5, 1});
  found.remedies.push_back({"grasp-g3", true, kNumFreshDraws, 8, 0});
  ASSERT_TRUE(found.FindBest(false) && found.FindBest(true));
  EXPECT_EQ(found.FindBest(false)->id, "lower");
  EXPECT_EQ(found.FindBest(true)->id, "grasp-g3");
  EXPECT_NE(DescribeExplanation(found).find("grasp g3 holds 9 of 20"), std::string::npos)
      << DescribeExplanation(found);
  EXPECT_EQ(SummariseExplanation(found), "the hand 8 mm lower: 5 of 20; grasp g3: 9 of 20");
}

}  // namespace
}  // namespace graspbench
