#include "workbench/experiments/grip_thresholds.h"

#include <gtest/gtest.h>

#include "core/trial/trial_runner.h"
#include "datasets/analysis/conditions/threshold_summary.h"
#include "datasets/analysis/export_result.h"
#include "tests/datasets/session/fake_session.h"

namespace graspbench {
namespace {

class GripThresholdsTest : public testing::Test {
 protected:
  void SetUp() override {
    SessionRequest request;
    request.config = SessionConfig();
    request.config->hands = {"tum"};
    request.config->objects = {"can"};
    request.config->trials = 2;
    request.out = temporary_.path() / "session";
    RunSession(PrepareSession(request), 1, observer_, stop_);
    request_.folder = request.out;
  }
  TemporaryFolder temporary_;
  Observer observer_;
  std::atomic<bool> stop_ = false;
  ExperimentRequest request_;
};

// What the rounds find is what one bisection finds that runs its trials by itself.
TEST_F(GripThresholdsTest, FindsWhatABisectionOfTheDrawFinds) {
  const ThresholdScale& scale = kThresholdScales[0];
  const PreparedSession experiment = PrepareThresholds(request_, scale);
  ASSERT_TRUE(RunThresholds(experiment, request_, 2, observer_, stop_));
  const Session session = LoadSession(request_.folder);
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
  ExportResult(request_.folder, session);
  EXPECT_TRUE(std::filesystem::exists(request_.folder / "export" / "thresholds.csv"));
}

TEST_F(GripThresholdsTest, GoesOnWhereItStopped) {
  const PreparedSession experiment = PrepareThresholds(request_, kThresholdScales[1]);
  stop_ = true;
  EXPECT_FALSE(RunThresholds(experiment, request_, 1, observer_, stop_));
  stop_ = false;
  ASSERT_TRUE(RunThresholds(PrepareThresholds(request_, kThresholdScales[1]), request_, 1,
                            observer_, stop_));
  EXPECT_EQ(LoadThresholds(LoadSession(request_.folder))[0].cells[0].num_draws, 2);
}

}  // namespace
}  // namespace graspbench
