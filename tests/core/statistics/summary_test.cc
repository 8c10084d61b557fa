#include "core/statistics/summary.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/random.h"

namespace graspbench {
namespace {

// NIST StRD, univariate summary statistics, data sets NumAcc1 to NumAcc4: the certified mean is the
// middle value, the certified standard deviation 1 or 0.1 exactly.
std::vector<double> MakeNumAcc(double middle, double low, double high) {
  std::vector<double> values = {middle};
  for (int i = 0; i < 500; ++i) values.insert(values.end(), {low, high});
  return values;
}

void ExpectCertified(const std::vector<double>& values, double mean, double spread,
                     double relative_error) {
  const Answer<Summary> summary = CalcSummary(values);
  ASSERT_TRUE(summary) << summary.reason();
  EXPECT_NEAR(summary->mean, mean, 1e-15 * mean);
  EXPECT_NEAR(*summary->standard_deviation / spread, 1.0, relative_error);
}

TEST(Summary, AgreesWithNistAsFarAsTheValuesAreRepresentable) {
  ExpectCertified({10000001, 10000003, 10000002}, 10000002, 1.0, 1e-15);
  ExpectCertified(MakeNumAcc(1.2, 1.1, 1.3), 1.2, 0.1, 1e-14);
  // 1000000.1 as a double is wrong by up to 6e-11, 10000000.1 by up to 9e-10.
  ExpectCertified(MakeNumAcc(1000000.2, 1000000.1, 1000000.3), 1000000.2, 0.1, 1e-9);
  ExpectCertified(MakeNumAcc(10000000.2, 10000000.1, 10000000.3), 10000000.2, 0.1, 1e-8);
}

TEST(Summary, QuartilesOfFive) {
  const Answer<Summary> summary = CalcSummary({5, 1, 4, 2, 3, std::nan("")});
  ASSERT_TRUE(summary);
  EXPECT_EQ(summary->count, 5);
  EXPECT_EQ(summary->num_missing, 1);
  EXPECT_EQ(summary->minimum, 1);
  EXPECT_EQ(summary->lower_quartile, 2);
  EXPECT_EQ(summary->median, 3);
  EXPECT_EQ(summary->upper_quartile, 4);
  EXPECT_EQ(summary->maximum, 5);
  // Between order statistics: R's default type 7.
  EXPECT_DOUBLE_EQ(CalcSortedQuantile({1, 2, 3, 10}, 0.9), 7.9);
}

TEST(Summary, SaysWhatItCannotKnow) {
  EXPECT_EQ(CalcSummary({}).reason(), "no values");
  EXPECT_EQ(CalcSummary({std::nan("")}).reason(), "no values");
  EXPECT_EQ(CalcSummary({1, std::numeric_limits<double>::infinity()}).reason(),
            "a value is infinite");
  const Answer<Summary> single = CalcSummary({7});
  ASSERT_TRUE(single);
  EXPECT_EQ(single->mean, 7);
  EXPECT_FALSE(single->standard_deviation.has_value());
}

TEST(Median, IsTheMiddleWhateverTheOrder) {
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(CalcMedian({3, 1, 2}), 2);
  EXPECT_EQ(CalcMedian({4, 1, 3, 2}), 2.5);
  EXPECT_EQ(CalcMedian({7}), 7);
  EXPECT_TRUE(std::isnan(CalcMedian({})));
  EXPECT_EQ(CalcMedian({infinity, 1, 2}), 2);
  EXPECT_EQ(CalcMedian({infinity, 1, infinity, 2}), infinity);
  EXPECT_EQ(CalcMedian({infinity, 1, infinity, infinity}), infinity);
  EXPECT_EQ(CalcMedianOfFinite({infinity, std::nan(""), 1, 2}), 1.5);
  EXPECT_TRUE(std::isnan(CalcMedianOfFinite({infinity})));
}

TEST(Median, IsTheSortedQuantileAtOneHalf) {
  RandomStream random("summary_test", "median");
  for (int size = 1; size < 60; ++size) {
    std::vector<double> values;
    for (int i = 0; i < size; ++i) values.push_back(random.NextNormal());
    const double median = CalcMedian(values);
    std::sort(values.begin(), values.end());
    EXPECT_EQ(median, CalcSortedQuantile(values, 0.5));
  }
}

TEST(Moments, ConstantMeansEqualUpToRounding) {
  EXPECT_TRUE(CalcMoments({0.1, 0.1, 0.1}).is_constant);
  EXPECT_TRUE(CalcMoments({0.3 - 0.1, 0.7 - 0.5, 0.9 - 0.7}, 0.9).is_constant);
  EXPECT_FALSE(CalcMoments({0.1, 0.1, 0.1 + 1e-12}).is_constant);
  EXPECT_FALSE(CalcMoments(MakeNumAcc(1e12 + 0.2, 1e12 + 0.1, 1e12 + 0.3)).is_constant);
}

}  // namespace
}  // namespace graspbench
