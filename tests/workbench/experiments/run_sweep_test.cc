#include "workbench/experiments/run_sweep.h"

#include <gtest/gtest.h>

#include "datasets/analysis/conditions/threshold_summary.h"
#include "datasets/plan/sweep_design.h"
#include "tests/datasets/session/fake_session.h"

namespace graspbench {
namespace {

TEST(RunSweep, RunsTrialsThenBisectionsAndGoesOnWhereItStopped) {
  const TemporaryFolder temporary;
  SweepConfig config;
  config.hands = {"tum"};
  config.objects = {"can"};
  config.trials = 1;
  config.factors = {"model.mass_scale=1,2"};
  SessionRequest request;
  request.config = MakeSweep(config);
  request.out = temporary.path() / "sweep";
  const PreparedSession sweep = PrepareSession(request);
  const double plain = EstimateSweepTime(sweep, false, false);
  EXPECT_GT(plain, 0.0);
  Observer observer;
  std::atomic<bool> stop = true;
  EXPECT_FALSE(RunSweep(sweep, &kThresholdScales[0], {}, 1, observer, stop));
  stop = false;
  ASSERT_TRUE(RunSweep(sweep, &kThresholdScales[0], {}, 1, observer, stop));
  const Session session = LoadSession(request.out);
  EXPECT_TRUE(FindUnfinished(session).empty());
  const std::vector<ThresholdSummary> thresholds = LoadThresholds(session);
  ASSERT_EQ(thresholds.size(), 1u);
  ASSERT_EQ(thresholds[0].draws.size(), 2u);
  for (const DrawThreshold& draw : thresholds[0].draws) EXPECT_FALSE(draw.found.next);
}

}  // namespace
}  // namespace graspbench
