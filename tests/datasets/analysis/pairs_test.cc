#include "datasets/analysis/pairs.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "datasets/analysis/conditions/sensitivity_summary.h"
#include "datasets/analysis/conditions/sweep_summary.h"
#include "datasets/analysis/session_comparison.h"
#include "tests/datasets/analysis/made_results.h"

namespace graspbench {
namespace {

constexpr char kFriction[] = "model.friction_scale=0.7";

/** One trial as it was planned and, unless it is missing, ran. */
struct MadeTrial {
  std::string object, grasp;
  int trial = 0;
  bool succeeds = true, is_missing = false;
  double gft_ratio = 0.3;
};

void AddTo(Session& session, const MadeTrial& made, std::optional<std::string> condition) {
  const PlannedTrial planned = {"id" + std::to_string(session.plan.size()),
                                "tum",
                                made.object,
                                made.grasp,
                                made.trial,
                                std::move(condition)};
  session.plan.push_back(planned);
  if (made.is_missing) return;
  TrialRecord record =
      MakeRecord(planned, made.succeeds ? Outcome::kSuccess : Outcome::kPushedAway);
  record.result.timing.gft_ratio = made.gft_ratio;
  session.records.push_back(record);
}

/** The same trials as a sweep, as a session with a sensitivity, and as two sessions. */
struct Asked {
  Session sweep, before, after;

  Asked(const std::vector<MadeTrial>& base, const std::vector<MadeTrial>& changed) {
    sweep.config.conditions = {{kFriction, {kFriction}}};
    for (const MadeTrial& made : base) {
      AddTo(sweep, made, std::nullopt);
      AddTo(before, made, std::nullopt);
    }
    for (const MadeTrial& made : changed) {
      AddTo(sweep, made, kFriction);
      AddTo(after, made, std::nullopt);
    }
  }
  const SweepEffect Sweep(const std::string& measure) const {
    for (const SweepEffect& effect : SummariseSweep(sweep, {}).effects) {
      if (effect.measure == measure) return effect;
    }
    ADD_FAILURE() << measure;
    return {};
  }
  SettingChange Sensitivity() const {
    VariedTrials trials;
    for (const PlannedTrial& planned : before.plan) trials[planned.id];
    for (const ComparedDraw& draw : ListComparedDraws({{&before}, {&sweep, kFriction}})) {
      if (draw.records[1]) trials[draw.planned[0]->id] = MakeTrialMeasures(*draw.records[1]);
    }
    return SummariseSensitivity(before, {{kFriction, trials}}).changes.at(0);
  }
  SessionComparison Compare() const { return CompareSessions(before, after); }
};

void ExpectSame(const SweepEffect& effect, const SettingChange& change) {
  EXPECT_EQ(effect.change.num_draws, change.successes.num_pairs());
  EXPECT_EQ(effect.change.num_objects, change.num_objects);
  EXPECT_EQ(effect.num_left_out, change.num_left_out);
  EXPECT_EQ(effect.num_other_grasp, change.num_other_grasp);
  EXPECT_NEAR(effect.change.estimate, change.rate_change(), 1e-12);
  EXPECT_EQ(effect.change.interval ? "" : effect.change.interval.reason(), change.no_interval);
  if (!effect.change.interval) return;
  EXPECT_EQ(effect.change.interval->low, change.rate_change_low);
  EXPECT_EQ(effect.change.interval->high, change.rate_change_high);
  EXPECT_GE(change.rate_change_low, -1.0);
  EXPECT_LE(change.rate_change_high, 1.0);
}

TEST(ComparedDraws, ThreeWaysOfAskingHaveOneAnswer) {
  std::mt19937 random(66);
  const auto draw = [&](int below) {
    return static_cast<int>(random() % static_cast<unsigned>(below));
  };
  for (int question = 0; question < 20; ++question) {
    SCOPED_TRACE(question);
    const int num_objects = 1 + draw(9), num_trials = 1 + draw(6), ease = draw(5);
    std::vector<MadeTrial> base, changed;
    for (int object = 0; object < num_objects; ++object) {
      for (int trial = 0; trial < num_trials; ++trial) {
        MadeTrial made = {"object" + std::to_string(object),
                          "g" + std::to_string(object % 3),
                          trial,
                          draw(4) < ease,
                          draw(12) == 0,
                          0.01 * draw(90)};
        base.push_back(made);
        made.succeeds = draw(5) < ease;
        made.is_missing = draw(12) == 0;
        made.gft_ratio = 0.01 * draw(90);
        if (object % 4 == 1) made.grasp = "g9";
        changed.push_back(made);
      }
    }
    base.front().is_missing = changed.front().is_missing = false;
    const Asked asked(base, changed);
    const SettingChange sensitivity = asked.Sensitivity();
    const SettingChange compare = asked.Compare().changes.at(0);
    ExpectSame(asked.Sweep("success"), sensitivity);
    ExpectSame(asked.Sweep("success"), compare);
    const SweepEffect gft = asked.Sweep("gft_ratio");
    for (const SettingChange* change : {&sensitivity, &compare}) {
      const MeasureChange& measure = change->Find("gft_ratio");
      EXPECT_EQ(gft.change.num_draws, measure.num_pairs);
      EXPECT_NEAR(gft.change.estimate, measure.change(), 1e-12);
      if (gft.change.interval) {
        EXPECT_EQ(gft.change.interval->low, measure.low);
      }
    }
  }
}

// Ten objects of five draws. Of two of them a grasp chosen again fails under the change, where the
// base's grasp holds: 80 % against 100 %, of 50 pairs.
TEST(ComparedDraws, PinnedAndFreeChoiceDifferByWhatTheGraspDoes) {
  std::vector<MadeTrial> base, pinned, again;
  for (int object = 0; object < 10; ++object) {
    for (int trial = 0; trial < 5; ++trial) {
      MadeTrial made = {"object" + std::to_string(object), "g1", trial};
      made.succeeds = object > 0 || trial > 0;  // one failure, so that success can be decided
      base.push_back(made);
      pinned.push_back(made);
      if (object == 4 || object == 7) {
        made.grasp = "g2";
        made.succeeds = false;
      }
      again.push_back(made);
    }
  }
  const Asked asked(base, pinned), asked_again(base, again);
  EXPECT_EQ(asked.Sweep("success").change.estimate, 0.0);
  EXPECT_EQ(asked.Sweep("success").change.num_draws, 50);
  EXPECT_EQ(asked.Sensitivity().rate_change(), 0.0);
  EXPECT_EQ(asked.Compare().changes.at(0).rate_change(), 0.0);
  EXPECT_EQ(asked.Compare().changes.size(), 1u);
  const SweepEffect free = asked_again.Sweep("success");
  EXPECT_NEAR(free.change.estimate, -0.2, 1e-12);
  EXPECT_EQ(free.change.num_draws, 50);
  EXPECT_EQ(free.num_other_grasp, 10);
  EXPECT_EQ(SummariseSweep(asked_again.sweep, {}).rows[1].other_grasps,
            "object4 g1 to g2, object7 g1 to g2");
  EXPECT_NEAR(asked_again.Sensitivity().rate_change(), -0.2, 1e-12);
  const SessionComparison comparison = asked_again.Compare();
  EXPECT_EQ(comparison.num_other_grasp(), 10);
  ASSERT_EQ(comparison.changes.size(), 2u);
  EXPECT_EQ(comparison.changes[0].setting, "all pairs");
  EXPECT_NEAR(comparison.changes[0].rate_change(), -0.2, 1e-12);
  EXPECT_EQ(comparison.changes[1].setting, "same grasp");
  EXPECT_EQ(comparison.changes[1].rate_change(), 0.0);
  EXPECT_EQ(comparison.changes[1].successes.num_pairs(), 40);
  EXPECT_EQ(comparison.changes[1].why_left_out, "10 with another grasp");
}

// A cup in two grasps on one side is paired grasp by grasp, a can in one grasp each whatever it is.
TEST(ComparedDraws, OnlyWhatIsGraspedInSeveralWaysIsPairedByGrasp) {
  const Asked asked({{"can", "g1", 0}, {"cup", "g1", 0}, {"cup", "g2", 0}},
                    {{"can", "g3", 0}, {"cup", "g2", 0}, {"cup", "g3", 0}});
  const std::vector<ComparedDraw> draws =
      ListComparedDraws({{&asked.sweep}, {&asked.sweep, kFriction}});
  int num_pairs = 0, num_single = 0;
  for (const ComparedDraw& draw : draws) {
    const bool is_pair = draw.planned[0] && draw.planned[1];
    num_pairs += is_pair;
    num_single += !is_pair;
    if (!is_pair) continue;
    EXPECT_EQ(draw.ChangesGrasp(0, 1), draw.object == "can");
  }
  EXPECT_EQ(num_pairs, 2);
  EXPECT_EQ(num_single, 2);
  EXPECT_EQ(asked.Sweep("success").why_left_out, "2 without a trial in each condition");
}

TEST(ComparedDraws, AnotherPlaceOfTheObjectIsAnotherDraw) {
  Asked asked({{"can", "g1", 0}}, {{"can", "g1", 0}});
  EXPECT_EQ(ListComparedDraws({{&asked.before}, {&asked.after}}).size(), 1u);
  asked.after.config.seed = 2;
  EXPECT_EQ(ListComparedDraws({{&asked.before}, {&asked.after}}).size(), 2u);
}

// Two objects are too few to draw from: the interval is Newcombe's of the pairs.
TEST(SuccessChange, OfFewObjectsHasTheIntervalOfItsPairs) {
  ObjectChanges changes;
  PairedCounts counts;
  const auto add = [&](const std::string& object, bool before, bool after) {
    counts.Add(before, after);
    changes[object].push_back(double(after) - double(before));
  };
  for (int i = 0; i < 10; ++i) add(i % 2 ? "can" : "cup", true, i > 3);
  const ChangeEstimate change = EstimateSuccessChange(changes, counts, "");
  EXPECT_TRUE(change.is_of_these_objects);
  EXPECT_EQ(change.num_objects, 2);
  EXPECT_NEAR(change.estimate, -0.4, 1e-12);
  ASSERT_TRUE(change.interval);
  EXPECT_EQ(change.interval->low, CalcPairedDifferenceInterval(counts).low);
  EXPECT_FALSE(EstimateSuccessChange(changes, std::nullopt, "").interval);
  EXPECT_EQ(EstimateSuccessChange(changes, counts, "all fail").interval.reason(), "all fail");
}

TEST(ExplainUndecided, SaysWhatTheComparedTrialsHaveInCommon) {
  EXPECT_EQ(ExplainUndecided({12, 12}), "success not testable: all 12 trials succeed");
  EXPECT_EQ(ExplainUndecided({12, 0}), "success not testable: all 12 trials fail");
  EXPECT_EQ(ExplainUndecided({12, 12}, {8, 3}),
            "success not testable: all 12 trials compared succeed, 5 of 8 left out fail");
  EXPECT_EQ(ExplainUndecided({12, 11}, {8, 3}), "");
}

}  // namespace
}  // namespace graspbench
