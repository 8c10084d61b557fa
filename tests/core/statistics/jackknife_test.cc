#include "core/statistics/jackknife.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/statistics/summary.h"

namespace graspbench {
namespace {

// Student's sleep data, difference of the two drugs; R 4.2: t.test(...): t = 4.0621, df = 9,
// p-value = 0.002833, 0.7001142 to 2.4598858.
TEST(Jackknife, OfTheMeanIsStudentsT) {
  const std::vector<double> extra = {1.2, 2.4, 1.3, 1.3, 0.0, 1.0, 1.8, 0.8, 4.6, 1.4};
  const auto mean = [&](const std::vector<size_t>& members) {
    double sum = 0.0;
    for (const size_t member : members) sum += extra[member];
    return sum / static_cast<double>(members.size());
  };
  const Answer<JackknifeInterval> result = CalcJackknife(extra.size(), mean);
  ASSERT_TRUE(result) << result.reason();
  EXPECT_NEAR(result->estimate, 1.58, 1e-12);
  EXPECT_NEAR(result->estimate / result->standard_error, 4.0621, 5e-5);
  EXPECT_NEAR(result->interval.low, 0.7001142, 5e-8);
  EXPECT_NEAR(result->interval.high, 2.4598858, 5e-8);
  EXPECT_NEAR(result->p, 0.002833, 5e-7);
}

TEST(Jackknife, GivesReasons) {
  const auto constant = [](const std::vector<size_t>&) { return 1.0; };
  EXPECT_EQ(CalcJackknife(2, constant).reason(), "2 to leave out; expected 3 or more");
  EXPECT_EQ(CalcJackknife(3, constant).reason(), "the statistic does not depend on who is drawn");
  const auto missing = [](const std::vector<size_t>& members) {
    return members.front() == 0 ? static_cast<double>(members.size()) : std::nan("");
  };
  EXPECT_EQ(CalcJackknife(3, missing).reason(), "the statistic has no value without member 1");
}

}  // namespace
}  // namespace graspbench
