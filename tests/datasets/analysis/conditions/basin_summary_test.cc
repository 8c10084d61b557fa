#include "datasets/analysis/conditions/basin_summary.h"

#include <gtest/gtest.h>

#include "core/statistics/proportion.h"

namespace graspbench {
namespace {

TEST(BasinSummary, CountsAndNamesTheRadiusInBothUnits) {
  std::vector<BasinSample> samples = MakeBasinSamples(10);
  for (BasinSample& sample : samples) {
    sample.outcome = Outcome::kSuccess;
    sample.sigma = 1.0;
  }
  samples[1].outcome = Outcome::kPushedAway;
  samples[1].sigma = kUnset;
  samples[2].sigma = 3.0;
  const BasinSummary summary = SummariseBasin(samples);
  EXPECT_EQ(summary.num_samples, 10);
  EXPECT_EQ(summary.num_successes, 9);
  EXPECT_EQ(summary.rate, FormatRate(9, 10));
  EXPECT_EQ(summary.most_sigma, 3.0);
  EXPECT_EQ(summary.radius, CalcBasinDistance(samples[1]));  // the only failure
  EXPECT_DOUBLE_EQ(summary.radius_offset, summary.radius * 0.01);
  EXPECT_DOUBLE_EQ(summary.radius_yaw, summary.radius * RadFromDeg(15.0));
}

TEST(BasinCsv, ARowASample) {
  std::vector<BasinSample> samples = MakeBasinSamples(1);
  samples[0].outcome = Outcome::kSuccess;
  samples[0].sigma = 2.5;
  EXPECT_EQ(FormatBasinCsv(samples),
            "offset_x_m,offset_y_m,yaw_rad,distance,outcome,sigma\n0.0,0.0,0.0,0.0,success,2.5\n");
}

}  // namespace
}  // namespace graspbench
