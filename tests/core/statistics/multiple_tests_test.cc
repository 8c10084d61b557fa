#include "core/statistics/multiple_tests.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace graspbench {
namespace {

TEST(MultipleTests, TheExampleOfBenjaminiAndHochberg) {
  // Their Table 1: four of fifteen are found at 0.05, by Holm three.
  const std::vector<double> p = {0.0001, 0.0004, 0.0019, 0.0095, 0.0201, 0.0278, 0.0298, 0.0344,
                                 0.0459, 0.3240, 0.4262, 0.5719, 0.6528, 0.7590, 1.0};
  const auto count = [](const std::vector<double>& adjusted) {
    return std::count_if(adjusted.begin(), adjusted.end(), [](double one) { return one <= 0.05; });
  };
  EXPECT_EQ(count(AdjustBenjaminiHochberg(p)), 4);
  EXPECT_EQ(count(AdjustHolm(p)), 3);
}

TEST(MultipleTests, FollowTheirTestsAndSkipThoseNotMade) {
  const std::vector<double> p = {0.04, std::nan(""), 0.001, 0.03, 0.012};
  const std::vector<double> adjusted = AdjustHolm(p);
  EXPECT_TRUE(std::isnan(adjusted[1]));
  EXPECT_NEAR(adjusted[2], 0.004, 1e-15);
  EXPECT_EQ(adjusted[0], adjusted[3]);
  EXPECT_EQ(AdjustHolm({0.7, 0.8}), (std::vector<double>{1.0, 1.0}));
  EXPECT_EQ(AdjustHolm({0.03}), (std::vector<double>{0.03}));
  EXPECT_TRUE(AdjustHolm({}).empty());
}

}  // namespace
}  // namespace graspbench
