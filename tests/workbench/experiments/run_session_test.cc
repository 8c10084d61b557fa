#include "workbench/experiments/run_session.h"

#include <gtest/gtest.h>

#include "datasets/session/judgement_store.h"
#include "tests/workbench/experiments/small_sessions.h"

namespace graspbench {
namespace {

class RunSessionTest : public SmallSessions {
 protected:
  RunRecord Run(const RoundKind& kind) {
    return RunRound(kind, {prepared_.config, prepared_.inputs, prepared_.folder, Load()}, 1,
                    observer_);
  }
  Session Load() const {
    return LoadSession(prepared_.folder, OnDamage::kRefuse, RecordParts::kBrief);
  }

  PreparedSession prepared_ = Prepare("session", MakeConfig({"golf_ball"}, 2));
};

// What the judge is asked for follows from the records of the trials before it.
TEST_F(RunSessionTest, AsksForWhatTheRecordsOfEarlierRoundsLeave) {
  EXPECT_TRUE(kJudgeRound.find_left(Load()).empty());
  EXPECT_EQ(kTrialRound.find_left(Load()).size(), 2u);
  const RunRecord trials = Run(kTrialRound);
  EXPECT_EQ(trials.num_trials, 2);
  EXPECT_EQ(trials.ending, RunEnding::kFinished);
  EXPECT_TRUE(kTrialRound.find_left(Load()).empty());
  const size_t num_held = kJudgeRound.find_left(Load()).size();
  ASSERT_GT(num_held, 0u);
  const RunRecord judged = Run(kJudgeRound);
  EXPECT_EQ(judged.num_trials, static_cast<int>(num_held));
  EXPECT_TRUE(kJudgeRound.find_left(Load()).empty());
  EXPECT_EQ(ListBuilds(prepared_.folder).size(), 2u);
}

TEST_F(RunSessionTest, WithNothingLeftIsFinishedAndNoRun) {
  const RunRecord nothing = Run(kJudgeRound);
  EXPECT_EQ(nothing.num_trials, 0);
  EXPECT_EQ(nothing.ending, RunEnding::kFinished);
  EXPECT_TRUE(ListBuilds(prepared_.folder).empty());
}

TEST_F(RunSessionTest, IsInterruptedAndSealed) {
  stop_ = true;
  EXPECT_EQ(Run(kTrialRound).ending, RunEnding::kInterrupted);
  EXPECT_EQ(kTrialRound.find_left(Load()).size(), 2u);
  EXPECT_TRUE(CheckStore(prepared_.folder).damages.empty());
}

}  // namespace
}  // namespace graspbench
