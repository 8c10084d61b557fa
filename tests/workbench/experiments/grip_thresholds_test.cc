#include <gtest/gtest.h>

#include "core/trial/trial_runner.h"
#include "datasets/analysis/conditions/threshold_summary.h"
#include "datasets/analysis/export_result.h"
#include "datasets/plan/conditions.h"
#include "datasets/session/merge_sessions.h"
#include "tests/workbench/experiments/small_sessions.h"
#include "workbench/experiments/machines/run_shard.h"

namespace graspbench {
namespace {
namespace fs = std::filesystem;

class GripThresholdsTest : public SmallSessions {
 protected:
  GripThresholdsTest() {
    static_cast<SessionConfig&>(config_) = MakeConfig({"can"}, 2);
    config_.grasps = {"g3"};
  }
  SweepConfig config_;
};

// What the rounds find is what one bisection finds that runs its trials by itself.
TEST_F(GripThresholdsTest, FindsWhatABisectionOfTheDrawFinds) {
  const ThresholdScale& scale = kThresholdScales[0];
  const ExperimentRequest request = RunNew("session", config_);
  const PreparedSession experiment = PrepareThresholds(request, scale);
  ASSERT_TRUE(RunExperiment(experiment, request, observer_));
  const Session session = LoadSession(request.folder);
  const std::vector<ThresholdSummary> found = LoadThresholds(session);
  ASSERT_EQ(found.size(), 1u);
  ASSERT_EQ(found[0].draws.size(), 2u);
  EXPECT_LE(found[0].num_trials, 2 * kMostThresholdTrials);
  for (const DrawThreshold& draw : found[0].draws) {
    TrialSetup setup = MakeTrialSetup(session.config, experiment.inputs, draw.draw);
    setup.object = CompleteObject(setup.object);
    TrialRunner runner(setup.hand, setup.object);
    setup.strategy.grip_force = 0.0;
    const GripThreshold alone = FindGripThreshold([&](int place) {
      setup.strategy.grip_margin = CalcGripAt(scale, place);
      return IsSuccess(runner.Run(setup).outcome);
    });
    EXPECT_EQ(draw.found.place, alone.place);
    EXPECT_EQ(draw.found.failed, alone.failed);
    EXPECT_EQ(draw.found.succeeded, alone.succeeded);
  }
  ExportResult(request.folder, session);
  EXPECT_TRUE(std::filesystem::exists(request.folder / "export" / "thresholds.csv"));
}

// With drives of a hundredth `run` refuses most of the scale: the search ends where it does.
TEST_F(GripThresholdsTest, OfForcesEndAtWhatDrivesGive) {
  SessionConfig weak = config_;
  weak.model.drive_torque_scale = 0.01;
  weak.trials = 1;
  weak.strategy.grip_force = 0.1;
  weak.strategy.grip = "force";
  const ExperimentRequest request = RunNew("weak", weak);
  const ThresholdScale& scale = kThresholdScales[1];
  const PreparedSession experiment = PrepareThresholds(request, scale);
  EXPECT_FALSE(ListThresholdWarnings(scale, experiment.config, experiment.inputs).empty());
  EXPECT_TRUE(
      ListThresholdWarnings(kThresholdScales[0], experiment.config, experiment.inputs).empty());
  ASSERT_TRUE(RunExperiment(experiment, request, observer_));
  const ThresholdSummary found = LoadThresholds(LoadSession(request.folder)).at(0);
  ASSERT_EQ(found.draws.size(), 1u);
  const int most = found.draws[0].most_place;
  ASSERT_LT(most, kMostGripPlace);
  for (const int place : {most, most + 1}) {
    SessionConfig asked = weak;
    asked.strategy.grip_force = CalcGripAt(scale, place);
    if (place == most) {
      EXPECT_NO_THROW(MakePlan(asked, LoadSessionInputs(asked)));
    } else {
      EXPECT_THROW(MakePlan(asked, LoadSessionInputs(asked)), Error);
    }
  }
  EXPECT_NE(DescribeCeilings(found).find("is asked of tum g3, the limit of its drives"),
            std::string::npos)
      << DescribeCeilings(found);
}

// Under a condition of a sweep as in a session of its own, and in shards as at once.
TEST_F(GripThresholdsTest, OfASweepAreThoseOfEachCondition) {
  const ThresholdScale& scale = kThresholdScales[0];
  SessionConfig heavy = config_;
  heavy.model.mass_scale = 2.0;
  const ExperimentRequest alone = RunNew("heavy", heavy);
  ASSERT_TRUE(RunExperiment(PrepareThresholds(alone, scale), alone, observer_));
  config_.factors = {"model.mass_scale=1,2"};
  const ExperimentRequest swept = RunNew("sweep", MakeSweep(config_));
  const fs::path folder = PrepareThresholds(swept, scale).folder;
  EXPECT_EQ(CountCards(folder), 2);
  for (const int number : {2, 1}) {
    ShardRequest shard;
    shard.folder = folder;
    shard.shard = {number, 2};
    const ShardResult result = WorkOnShard(shard, observer_);
    EXPECT_EQ(result.num_left, 0);
  }
  MergeSessions(folder, {});
  EXPECT_TRUE(FindThresholdTrials(LoadSession(folder)).empty());
  const ThresholdSummary one = LoadThresholds(LoadSession(alone.folder)).at(0);
  const ThresholdSummary both = LoadThresholds(LoadSession(swept.folder)).at(0);
  ASSERT_EQ(both.draws.size(), 4u);
  ASSERT_EQ(both.cells.size(), 2u);
  EXPECT_EQ(both.cells[1].condition, "model.mass_scale=2.0");
  EXPECT_EQ(both.cells[1].median, one.cells[0].median);
  EXPECT_EQ(both.cells[1].not_monotone, one.cells[0].not_monotone);
  EXPECT_LE(both.num_trials, 4 * kMostThresholdTrials);
  ExportResult(swept.folder, LoadSession(swept.folder));
  for (const char* file : {"thresholds.csv", "effects.csv", "conditions.csv"}) {
    EXPECT_TRUE(fs::exists(swept.folder / "export" / file)) << file;
  }
}

// A sweep runs its trials, then the bisections, and goes on where it stopped.
TEST_F(GripThresholdsTest, AreAskedForWithASweep) {
  config_.trials = 1;
  config_.factors = {"model.mass_scale=1,2"};
  const PreparedSession sweep = Prepare("sweep", MakeSweep(config_));
  EXPECT_GT(EstimateSweepTime(sweep, false, false), 0.0);
  ExperimentRequest request;
  request.thresholds = &kThresholdScales[0];
  stop_ = true;
  EXPECT_FALSE(RunExperiment(sweep, request, observer_));
  stop_ = false;
  ASSERT_TRUE(RunExperiment(sweep, request, observer_));
  const Session session = LoadSession(sweep.folder);
  EXPECT_TRUE(FindUnfinished(session).empty());
  const std::vector<ThresholdSummary> thresholds = LoadThresholds(session);
  ASSERT_EQ(thresholds.size(), 1u);
  ASSERT_EQ(thresholds[0].draws.size(), 2u);
  for (const DrawThreshold& draw : thresholds[0].draws) EXPECT_FALSE(draw.found.next);
}

}  // namespace
}  // namespace graspbench
