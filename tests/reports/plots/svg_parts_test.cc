#include "reports/plots/svg_parts.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace graspbench {
namespace {

TEST(CalcTickStep, IsRoundAndFits) {
  EXPECT_DOUBLE_EQ(CalcTickStep(1.0, 5), 0.2);
  EXPECT_DOUBLE_EQ(CalcTickStep(0.9, 5), 0.2);
  EXPECT_DOUBLE_EQ(CalcTickStep(30.0, 5), 10.0);
  EXPECT_DOUBLE_EQ(CalcTickStep(0.0031, 4), 0.001);
  for (double range = 1e-6; range < 1e6; range *= 1.37) {
    EXPECT_LE(range / CalcTickStep(range, 5), 5.0 + 1e-9) << range;
    EXPECT_GT(range / CalcTickStep(range, 5), 1.9) << range;
  }
}

TEST(Axis, EndsAreRoundAndHoldTheValues) {
  const Axis axis(-0.03, 1.1, 5);
  ASSERT_EQ(axis.ticks().size(), 5U);  // -0.5, 0, 0.5, 1, 1.5
  EXPECT_EQ(axis.ticks().front().text, "-0.5");
  EXPECT_EQ(axis.ticks().back().text, "1.5");
  EXPECT_DOUBLE_EQ(axis.CalcShare(-0.5), 0.0);
  EXPECT_DOUBLE_EQ(axis.CalcShare(0.5), 0.5);
  EXPECT_DOUBLE_EQ(axis.CalcShare(1.5), 1.0);
}

TEST(Axis, OneValueOrNoneStillHasALength) {
  EXPECT_GE(Axis(3.0, 3.0, 5).ticks().size(), 2U);
  const double infinity = std::numeric_limits<double>::infinity();
  const Axis none(infinity, -infinity, 5);
  EXPECT_TRUE(std::isfinite(none.CalcShare(0.5)));
}

}  // namespace
}  // namespace graspbench
