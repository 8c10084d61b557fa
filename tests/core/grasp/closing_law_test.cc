#include "core/grasp/closing_law.h"

#include <gtest/gtest.h>

namespace graspbench {
namespace {

constexpr double kClosingStep = 0.002, kTime = 0.8;

double CalcAfter(const ClosingSchedule& schedule, double time) {
  ClosingLaw law(schedule);
  for (int i = 0; i < std::lround(time / kClosingStep); ++i) law.Advance(kClosingStep, kTime, 1.0);
  return law.closing();
}

TEST(ClosingLaw, IsTheClippedLine) {
  for (const double delay : {0.0, 0.05, 0.3}) {
    for (const double speed : {0.5, 1.0, 2.0}) {
      for (const double time : {0.0, 0.04, 0.2, 0.5, 3.0}) {
        const double line = std::clamp((time - delay) * speed / kTime, 0.0, 1.0);
        EXPECT_NEAR(CalcAfter({delay, speed}, time), line, 1e-12) << delay << " " << speed;
      }
    }
  }
}

// The thesis's common s was a sum of steps; one digit's is the same number.
TEST(ClosingLaw, WithoutAScheduleItIsTheCommonSumToTheBit) {
  ClosingLaw law;
  double sum = 0.0;
  for (int i = 0; i < 500; ++i) {
    sum = std::min(1.0, sum + kClosingStep / kTime);
    law.Advance(kClosingStep, kTime, 1.0);
    ASSERT_EQ(law.closing(), sum);
  }
}

TEST(ClosingLaw, ASlowerShareIsSlowerByThat) {
  ClosingLaw law;
  for (int i = 0; i < 100; ++i) law.Advance(kClosingStep, kTime, 0.25);
  EXPECT_NEAR(law.closing(), 0.25 * 100 * kClosingStep / kTime, 1e-12);
}

TEST(ClosingLaw, NeverLeavesTheWayBetweenThePostures) {
  ClosingLaw law;
  law.MoveTo(-0.2);
  EXPECT_EQ(law.closing(), 0.0);
  law.MoveTo(1.3);
  EXPECT_EQ(law.closing(), 1.0);
}

TEST(ClosingLaw, TimeToTheTarget) {
  EXPECT_DOUBLE_EQ(CalcClosingTime({0.1, 0.5}, kTime), 1.7);
  EXPECT_LT(CalcAfter({0.1, 0.5}, 1.69), 1.0);
  EXPECT_NEAR(CalcAfter({0.1, 0.5}, 1.702), 1.0, 1e-12);
}

}  // namespace
}  // namespace graspbench
