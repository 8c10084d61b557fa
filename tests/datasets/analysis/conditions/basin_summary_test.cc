#include "datasets/analysis/conditions/basin_summary.h"

#include <gtest/gtest.h>

#include "core/statistics/proportion.h"
#include "tests/datasets/analysis/made_results.h"

namespace graspbench {
namespace {

// The first points of the sequence: 1/2, 1/3, 1/5; 1/4, 2/3, 2/5; 3/4, 1/9, 3/5.
TEST(Basin, SamplesAreTheHaltonSequenceAroundTheNominalPose) {
  const std::vector<BasinSample> samples = MakeBasinSamples(4);
  ASSERT_EQ(samples.size(), 4u);
  EXPECT_EQ(CalcBasinDistance(samples[0]), 0.0);
  EXPECT_NEAR(samples[1].offset_x, 0.0, 1e-15);
  EXPECT_NEAR(samples[1].offset_y, -kBasinOffset / 3.0, 1e-15);
  EXPECT_NEAR(samples[1].yaw, -0.6 * kBasinYaw, 1e-15);
  EXPECT_NEAR(samples[3].offset_x, 0.5 * kBasinOffset, 1e-15);
  EXPECT_NEAR(samples[3].offset_y, -7.0 / 9.0 * kBasinOffset, 1e-15);
  EXPECT_NEAR(samples[3].yaw, 0.2 * kBasinYaw, 1e-15);
}

// A disc of 4 mm succeeds: the nearest failing sample lies just outside of 0.4.
TEST(Basin, RadiusIsThatOfTheNearestFailure) {
  std::vector<BasinSample> samples = MakeBasinSamples(3000);
  for (BasinSample& sample : samples) {
    sample.outcome = CalcBasinDistance(sample) < 0.4 ? Outcome::kSuccess : Outcome::kPushedAway;
  }
  EXPECT_GE(CalcBasinRadius(samples), 0.4);
  EXPECT_LT(CalcBasinRadius(samples), 0.42);
  for (BasinSample& sample : samples) sample.outcome = Outcome::kSuccess;
  EXPECT_EQ(CalcBasinRadius(samples), 1.0);
  samples[0].outcome = Outcome::kNoContact;
  EXPECT_EQ(CalcBasinRadius(samples), 0.0);
}

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
