#include "workbench/text/trial_text.h"

#include <gtest/gtest.h>

#include <cmath>

namespace graspbench {

namespace {

/** A small session as `run` would keep it, and what a look at a trial that succeeded gives. */
class TrialTextTest : public testing::Test {
 protected:
  TrialTextTest() {
    session_.config.hands = {"tum"};
    session_.config.objects = {"golf_ball"};
    session_.config.grasps = {"g1"};
    session_.config.trials = 4;
    session_.config.strategy = StrategyConfig();  // by posture, which holds two of them or more
    const SessionInputs inputs = LoadSessionInputs(session_.config);
    session_.plan = MakePlan(session_.config, inputs);
    for (const PlannedTrial& planned : session_.plan) {
      const TrialSetup setup = MakeTrialSetup(session_.config, inputs, planned);
      session_.records.push_back({planned, TrialRunner(setup.hand, setup.object).Run(setup)});
    }
  }
  void SetUp() override {
    for (size_t i = 0; i < session_.records.size(); ++i) {
      if (IsSuccess(session_.records[i].result.outcome)) successes_.push_back(i);
    }
    ASSERT_GE(successes_.size(), 2u);
    shown_ = successes_[0];
  }
  ExaminedTrial Examine() const { return ExamineTrial(session_, session_.plan[shown_], 0.01); }

  Session session_;
  std::vector<size_t> successes_;
  size_t shown_ = 0;
};

TEST_F(TrialTextTest, ARecordThatHoldsIsConfirmed) {
  const ExaminedTrial trial = Examine();
  EXPECT_FALSE(trial.difference);
  const std::string text = FormatTrial(trial, "results/a b");
  EXPECT_NE(text.find("re-simulation matches the record"), text.npos) << text;
  EXPECT_NE(text.find(session_.plan[shown_].id), text.npos);
  EXPECT_NE(text.find("outcome  success\n"), text.npos);
  EXPECT_EQ(text.find("nearest"), text.npos) << "a success needs no example";
  const Json json = MakeTrialJson(trial, "results/a b");
  EXPECT_EQ(json.at("result"), ToJson(session_.records[shown_].result));
  EXPECT_TRUE(json.at("difference").is_null());
  EXPECT_NE(json.at("nearest_success").at("trial_id"), session_.plan[shown_].id);
}

TEST_F(TrialTextTest, OneDigitInARecordIsNamed) {
  session_.records[shown_].result.grip_force =
      std::nextafter(session_.records[shown_].result.grip_force, 1e3);
  const ExaminedTrial trial = Examine();
  ASSERT_TRUE(trial.difference);
  EXPECT_EQ(trial.difference->field, "grip_force_n");
  EXPECT_NE(FormatTrial(trial, "s").find("differs from its record in grip_force_n"),
            std::string::npos);
}

TEST_F(TrialTextTest, AnUnfinishedTrialHasNothingToCompareWith) {
  session_.records.erase(session_.records.begin() + static_cast<long>(shown_));
  const ExaminedTrial trial = Examine();
  EXPECT_FALSE(trial.recorded);
  EXPECT_FALSE(trial.difference);
  EXPECT_NE(FormatTrial(trial, "s").find("not run yet in this session"), std::string::npos);
}

TEST_F(TrialTextTest, ForcesSayWhetherTheyAreFeltOrTrueAndReasonsWhichJoint) {
  ExaminedTrial trial = Examine();
  TrialResult& result = trial.traced.result;
  const auto says = [&](const std::string& part) {
    return FormatTrial(trial, "s").find(part) != std::string::npos;
  };
  GripRecord grip;
  grip.asked = 2.0;
  grip.held = 1.9;
  grip.peak = 2.4;
  grip.digits.push_back({"FF", false, 1.0, 0.7, 0.7, 1.0, GripFault::kLimit, "FFJ3"});
  result.grip = grip;
  EXPECT_TRUE(says(
      "total setpoint 2.00 N, 1.90 N in the hold, filtered peak 2.40 N; object never lifted\n"))
      << FormatTrial(trial, "s");
  EXPECT_TRUE(says("limit (FFJ3)"));
  result.grip->held = kUnset;
  EXPECT_TRUE(says("total setpoint 2.00 N, filtered peak"));
  result.grip->held = 1.9;
  EXPECT_FALSE(says("felt"));
  result.grip->closed = 1.9;
  EXPECT_TRUE(says("2.40 N; outside the tolerance at lift-off\n"));
  EXPECT_FALSE(says("times the setpoint"));
  result.touch = TouchRecord();
  result.stability.hold.normal_force = 2.5;
  EXPECT_TRUE(says("true total grip in the hold 2.50 N, 1.25 times the setpoint\n"));
  EXPECT_TRUE(says("estimated 1.90 N in the hold, filtered estimated peak 2.40 N"));
  EXPECT_TRUE(says("largest true force [N]"));
  EXPECT_TRUE(says("estimated in the hold [N]"));
}

TEST_F(TrialTextTest, ATouchAfterLiftOffIsNoNever) {
  ExaminedTrial trial = Examine();
  EXPECT_EQ(FormatTrial(trial, "s").find("after lift-off"), std::string::npos);
  trial.traced.result.contacts[0].time = kUnset;  // its forces in the trace stay
  EXPECT_NE(FormatTrial(trial, "s").find("after lift-off"), std::string::npos);
  EXPECT_EQ(FormatTrial(trial, "s").find("closure starts before"), std::string::npos);
  trial.setup.strategy.closure_lead = 0.2;
  EXPECT_NE(FormatTrial(trial, "s").find("closure starts before arrival by 0.200 s"),
            std::string::npos);
}

// The object is out of the fingers' reach: nothing touches it, and the other trial is shown beside.
TEST_F(TrialTextTest, AFailureHasTheNearestSuccessBesideIt) {
  ExaminedTrial trial = Examine();
  trial.setup.draw.offset_x = 0.3;
  TrialRunner runner(trial.setup.hand, trial.setup.object);
  trial.traced = TraceTrial(runner, trial.setup, 0.01);
  const std::string text = FormatTrial(trial, "s");
  EXPECT_FALSE(IsSuccess(trial.traced.result.outcome));
  EXPECT_NE(text.find("nearest  success: tum-golf_ball-"), text.npos) << text;
  EXPECT_NE(text.find("never"), text.npos) << text;
}

SessionReplay MakeReplay() {
  SessionReplay replay;
  const auto plan = [](const char* id, int trial) {
    return PlannedTrial{id, "tum", "can", "g2", trial};
  };
  replay.trials = {
      {plan("aaaa", 0), true, false, Outcome::kSuccess, std::nullopt},
      {plan("bbbb", 1), true, true, Outcome::kPushedAway, FieldDifference{"num_steps", "9", "8"}},
      {plan("cccc", 2), false, false, Outcome::kSuccess, std::nullopt}};
  replay.conditions = {8, 8, {"11", "22"}, "11", 0};
  return replay;
}

TEST(ReplayText, NamesTrialFieldAndBothValues) {
  const std::string all = FormatReplay(MakeReplay(), true);
  EXPECT_NE(all.find("aaaa tum-can-g2:0, success: re-simulation matches the record\n"), all.npos);
  const std::string text = FormatReplay(MakeReplay(), false);
  EXPECT_EQ(text.find("aaaa"), text.npos);
  EXPECT_NE(
      text.find("bbbb tum-can-g2:1, pushed away: num_steps differs: recorded 9, now 8; its line "
                "fails its checksum\n"),
      text.npos)
      << text;
  EXPECT_NE(text.find("cccc tum-can-g2:2, success: has no record"), text.npos);
  EXPECT_NE(text.find("same     1 of 3 trials\nphysics  version 8, the same\n"
                      "build    11, recorded with 11, 22\n"),
            text.npos)
      << text;
}

TEST(ReplayText, SaysThatPhysicsOrInputsAreOthers) {
  SessionReplay replay = MakeReplay();
  replay.conditions = {7, 8, {"11"}, "11", 3};
  const std::string text = FormatReplay(replay, false);
  EXPECT_NE(text.find("physics  version 8, recorded with 7: "), text.npos);
  EXPECT_NE(text.find("build    11, the same\n"), text.npos);
  EXPECT_EQ(text.find("inputs"), text.npos) << "every id changes with the physics";
  replay.conditions = {8, 8, {}, "11", 3};
  EXPECT_NE(FormatReplay(replay, false).find("hand, object or grasp of 3 trials have changed"),
            std::string::npos);
}

}  // namespace

}  // namespace graspbench
