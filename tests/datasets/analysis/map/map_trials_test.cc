#include "datasets/analysis/map/map_trials.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/datasets/analysis/map/made_map.h"

namespace graspbench {
namespace {

TEST(MapTrials, SayWhatTheirConditionAndRecordSay) {
  Session session = MakeMapSessionResult();
  session.records[0].result.contacts[2].time = kUnset;  // the middle finger never touches
  const MapData data = ListMapTrials(session, {});
  ASSERT_EQ(data.trials.size(), session.records.size());
  EXPECT_EQ(data.factors.size(), ListMapFactors().size());
  EXPECT_TRUE(data.factors[4].scales_draws);
  EXPECT_TRUE(std::isinf(data.trials[0].first_to_last));
  EXPECT_TRUE(std::isinf(data.trials[0].values[static_cast<size_t>(MapMeasure::kPush)]));
  const MapTrial& trial = data.trials[1];
  EXPECT_NEAR(trial.first_to_last, 0.05, 1e-12);
  EXPECT_NEAR(trial.values[static_cast<size_t>(MapMeasure::kPush)], 0.001 + trial.delay, 1e-12);
  EXPECT_TRUE(std::isnan(trial.values[static_cast<size_t>(MapMeasure::kThreshold)]));
  EXPECT_LE(trial.offset, std::sqrt(2.0) * 0.01);
}

TEST(MapTrials, ANumericalFailureSaysNothing) {
  Session session = MakeMapSessionResult();
  session.records[3].result.outcome = Outcome::kNumericalFailure;
  EXPECT_EQ(ListMapTrials(session, {}).trials.size(), session.records.size() - 1);
}

}  // namespace
}  // namespace graspbench
