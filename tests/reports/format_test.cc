#include "reports/format.h"

#include <gtest/gtest.h>

#include <cmath>

namespace graspbench {
namespace {

TEST(Format, DecimalsAreFixed) {
  EXPECT_EQ(FormatFixed(0.5, 3), "0.500");
  EXPECT_EQ(FormatFixed(1234567.0, 0), "1234567");
  EXPECT_EQ(FormatFixed(-2.345, 1), "-2.3");
  EXPECT_EQ(FormatFixed(1e300, 1).size(), 303u);
}

TEST(Format, ZeroHasNoSign) {
  EXPECT_EQ(FormatFixed(-0.0, 2), "0.00");
  EXPECT_EQ(FormatFixed(-0.0004, 3), "0.000");
  EXPECT_EQ(FormatFixed(-0.0006, 3), "-0.001");
}

TEST(Format, WhatIsMissingIsNoNumber) {
  EXPECT_EQ(FormatFixed(std::nan(""), 3), "n/a");
  EXPECT_EQ(FormatSignificant(INFINITY, 3), "n/a");
  EXPECT_EQ(FormatPercent(std::nan("")), "n/a");
}

TEST(Format, SignificantDigits) {
  EXPECT_EQ(FormatSignificant(0.0012345, 3), "0.00123");
  EXPECT_EQ(FormatSignificant(123456.0, 3), "1.23e+05");
  EXPECT_EQ(FormatSignificant(0.0, 3), "0");
}

TEST(Format, CountsKnowTheirPlural) {
  EXPECT_EQ(FormatCount(1, "trial"), "1 trial");
  EXPECT_EQ(FormatCount(0, "trial"), "0 trials");
}

// 9 of 10: 59.58 to 98.21 % (Wilson 1927; table in Newcombe 1998 for the method).
TEST(Format, ARateComesWithCountsAndInterval) {
  EXPECT_EQ(FormatRate(9, 10),
            "9 of 10 trials (90.0\u00A0%, 95\u00A0% interval 59.6 to 98.2\u00A0%)");
  EXPECT_EQ(FormatRate(0, 0), "0 of 0 trials");
  EXPECT_EQ(FormatRateInterval(0, 0), "n/a");
}

}  // namespace
}  // namespace graspbench
