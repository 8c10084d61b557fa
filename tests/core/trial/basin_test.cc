#include "core/trial/basin.h"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace graspbench
