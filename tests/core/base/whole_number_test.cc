#include "core/base/whole_number.h"

#include <gtest/gtest.h>

#include <cstdint>

namespace graspbench {
namespace {

TEST(WholeNumberTest, EveryNumberHasAResult) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(ToWhole<int>(-2.9), -2);
  EXPECT_EQ(ToWhole<size_t>(2.9), 2u);
  EXPECT_EQ(ToWhole<size_t>(-1.0), 0u);
  EXPECT_EQ(ToWhole<size_t>(std::nan("")), 0u);
  EXPECT_EQ(ToWhole<uint8_t>(255.9), 255);
  EXPECT_EQ(ToWhole<uint8_t>(256.0), 255);
  EXPECT_EQ(ToWhole<int64_t>(9223372036854775807.0), INT64_MAX);  // is 2^63
  EXPECT_EQ(ToWhole<int64_t>(-9223372036854775808.0), INT64_MIN);
  EXPECT_EQ(ToWhole<int64_t>(9223372036854774784.0), 9223372036854774784);
  EXPECT_EQ(ToWhole<int>(kInfinity), INT32_MAX);
  EXPECT_EQ(ToWhole<int>(-kInfinity), INT32_MIN);
}

}  // namespace
}  // namespace graspbench
