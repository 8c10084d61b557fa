#include "core/base/text/range_text.h"

#include <gtest/gtest.h>

#include <cmath>

namespace graspbench {
namespace {

TEST(RangeText, NamesTheRangeBehindTheValue) {
  EXPECT_EQ(FormatRange(-0.001, 0.25, 2), "0.00 to 0.25");
  EXPECT_EQ(FormatWithRange(0.5, 0.25, 1.0, 1), "0.5 (0.2 to 1.0)");
  EXPECT_EQ(FormatWithRange(0.5, std::nan(""), std::nan(""), 1), "0.5");
}

TEST(RangeText, NamesAllWhereOnlySomeCount) {
  EXPECT_EQ(FormatCountOf(6, 10), "6 of 10");
  EXPECT_EQ(FormatCountOf(10, 10), "10");
}

}  // namespace
}  // namespace graspbench
