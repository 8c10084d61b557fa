#include <gtest/gtest.h>

#include "datasets/analysis/conditions/delay_summary.h"
#include "tests/datasets/session/fake_session.h"
#include "workbench/experiments/session_experiment.h"

namespace graspbench {
namespace {

class DelaySweepTest : public testing::Test {
 protected:
  void SetUp() override {
    SessionRequest request;
    request.config = SessionConfig();
    request.config->hands = {"tum"};
    request.config->objects = {"golf_ball"};
    request.config->trials = 2;
    request.out = temporary_.path() / "session";
    RunRound(kTrialRound, PrepareSession(request), 1, observer_, stop_);
    folder_ = request.out;
  }

  TemporaryFolder temporary_;
  Observer observer_;
  std::atomic<bool> stop_ = false;
  std::vector<DelayedTrial> Sweep(const std::filesystem::path& folder, int num_workers) {
    ExperimentRequest request;
    request.folder = folder;
    request.trials_per_cell = 1;
    const PreparedSession experiment = PrepareExperiment(request, "delays", ListDelayConditions);
    is_finished_ = RunExperiment(experiment, request, num_workers, observer_, stop_);
    return ListDelayedTrials(LoadSession(experiment.folder));
  }
  std::filesystem::path folder_;
  bool is_finished_ = false;
};

TEST_F(DelaySweepTest, WithoutDelayItIsTheSessionsTrial) {
  const Session session = LoadSession(folder_);
  const std::filesystem::path copy = temporary_.path() / "copy";
  std::filesystem::copy(folder_, copy, std::filesystem::copy_options::recursive);
  const std::vector<DelayedTrial> trials = Sweep(folder_, 2);
  const size_t num_delays = ListDelays().size();
  ASSERT_EQ(trials.size(), 4 * 2 * num_delays);
  const double gft = session.records[0].result.timing.gft;
  int num_undelayed = 0;
  for (const DelayedTrial& trial : trials) {
    EXPECT_EQ(trial.record.plan.trial, 0);
    if (trial.condition == "as run" && trial.delay == 0.0) {
      EXPECT_EQ(ToJson(trial.record.result), ToJson(session.records[0].result));
      ++num_undelayed;
    }
    // The last digit comes later still, by the delay or nearly: the others push the object to it.
    if (trial.condition == "as run" && trial.digit == "last" && trial.delay == 0.1) {
      EXPECT_GT(trial.record.result.timing.gft, gft + 0.03);
      EXPECT_LT(trial.record.result.timing.gft, gft + 0.12);
    }
  }
  const std::vector<DelayedTrial> alone = Sweep(copy, 1);
  ASSERT_EQ(alone.size(), trials.size());
  for (size_t i = 0; i < trials.size(); ++i) {
    EXPECT_EQ(ToJson(trials[i].record), ToJson(alone[i].record)) << "workers matter: " << i;
  }
  EXPECT_EQ(num_undelayed, 2);  // one for each digit that may be late
}

TEST_F(DelaySweepTest, AStoppedOneSaysSoAndGoesOn) {
  stop_ = true;
  Sweep(folder_, 1);
  EXPECT_FALSE(is_finished_);
  stop_ = false;
  EXPECT_EQ(Sweep(folder_, 1).size(), 4 * 2 * ListDelays().size());
  EXPECT_TRUE(is_finished_);
}

}  // namespace
}  // namespace graspbench
