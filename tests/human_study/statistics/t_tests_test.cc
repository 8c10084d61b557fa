#include "human_study/statistics/t_tests.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/statistics/distributions.h"
#include "tests/human_study/statistics/reach_study.h"

namespace graspbench {
namespace {

std::vector<double> ListColumn(Eigen::Index column) {
  const Eigen::MatrixXd means = MakeReachMeans();
  return {means.col(column).begin(), means.col(column).end()};
}

TEST(Distributions, AgreeWithClosedForms) {
  constexpr double kPi = 3.14159265358979324;
  for (double t : {0.0, 0.3, 1.0, 4.0, 50.0}) {
    // One degree of freedom is Cauchy, two have an algebraic form.
    EXPECT_NEAR(CalcStudentUpperP(t, 1.0), 0.5 - std::atan(t) / kPi, 1e-15);
    EXPECT_NEAR(CalcStudentUpperP(t, 2.0), 0.5 - t / (2.0 * std::sqrt(2.0 + t * t)), 1e-15);
    EXPECT_NEAR(CalcFisherUpperP(t * t, 1.0, 7.5), CalcStudentTwoSidedP(t, 7.5), 1e-14);
    EXPECT_NEAR(CalcChiSquaredUpperP(t, 2.0), std::exp(-t / 2.0), 1e-15);
  }
  EXPECT_NEAR(CalcChiSquaredUpperP(200.0, 2.0) / std::exp(-100.0), 1.0, 1e-13);  // no 1 - p
  EXPECT_NEAR(CalcNormalQuantile(0.975), 1.959963984540054, 1e-15);
  EXPECT_NEAR(CalcNormalP(-1.959963984540054), 0.025, 1e-16);
  for (double p : {0.001, 0.3, 0.975}) {
    EXPECT_NEAR(CalcStudentUpperP(CalcStudentQuantile(p, 6.3), 6.3), 1.0 - p, 1e-13);
    EXPECT_NEAR(CalcFisherUpperP(CalcFisherQuantile(p, 3.0, 20.0), 3.0, 20.0), 1.0 - p, 1e-13);
    EXPECT_NEAR(CalcChiSquaredUpperP(CalcChiSquaredQuantile(p, 5.0), 5.0), 1.0 - p, 1e-13);
  }
}

TEST(PairedT, AgreesWithR) {
  const Answer<TTest> test = CalcPairedTTest(ListColumn(3), ListColumn(0));
  ASSERT_TRUE(test) << test.reason();
  EXPECT_NEAR(test->t, 13.67523, 5e-6);
  EXPECT_NEAR(test->p, 2.6337e-06, 5e-11);
  EXPECT_NEAR(test->interval.low, 30.80899, 5e-6);
  EXPECT_NEAR(test->interval.high, 43.69101, 5e-6);
  EXPECT_NEAR(test->d_z, 4.834925, 5e-7);
  EXPECT_EQ(test->df, 7.0);
  EXPECT_EQ(test->count, 8);
}

TEST(PairedT, IsOddUnderExchangeAndLeavesOutTheMissing) {
  std::vector<double> a = ListColumn(3), b = ListColumn(0);
  const Answer<TTest> forwards = CalcPairedTTest(a, b), backwards = CalcPairedTTest(b, a);
  EXPECT_DOUBLE_EQ(forwards->t, -backwards->t);
  EXPECT_DOUBLE_EQ(forwards->p, backwards->p);
  a.push_back(std::nan(""));
  b.push_back(1.0);
  const Answer<TTest> longer = CalcPairedTTest(a, b);
  EXPECT_EQ(longer->t, forwards->t);
  EXPECT_EQ(longer->num_missing, 1);
}

TEST(TTest, GivesAReasonInsteadOfANumber) {
  EXPECT_EQ(CalcTTest({}).reason(), "0 persons with a value; expected 2 or more");
  EXPECT_EQ(CalcTTest({1.0, std::nan("")}).reason(), "1 person with a value; expected 2 or more");
  EXPECT_EQ(CalcTTest({0.1, 0.1, 0.1}).reason(),
            "all 3 values are equal: no spread to test against");
  EXPECT_EQ(CalcPairedTTest({0.3, 0.7, 0.9}, {0.1, 0.5, 0.7}).reason(),
            "all 3 values are equal: no spread to test against");
  EXPECT_EQ(CalcTTest({1.0, INFINITY}).reason(), "a value is infinite");
  EXPECT_EQ(CalcPairedTTest({INFINITY, 1.0}, {INFINITY, 2.0}).reason(), "a value is infinite");
  EXPECT_EQ(CalcEquivalence(CalcTTest({}), {-1, 1}).reason(), CalcTTest({}).reason());
  EXPECT_EQ(CalcEquivalence(CalcTTest({1, 2}), {1, 1}).reason(),
            "the lower bound is not below the upper one");
}

TEST(Equivalence, AgreesWithTwoOneSidedTestsOfR) {
  // Slopes of the reaching study against 0.82 +- 0.1.
  const Answer<TTest> test = CalcTTest(
      {61.0 / 75, 66.0 / 75, 43.0 / 75, 78.5 / 75, 51.0 / 75, 70.0 / 75, 54.0 / 75, 72.0 / 75});
  const Answer<EquivalenceTest> result = CalcEquivalence(test, {0.72, 0.92});
  ASSERT_TRUE(result) << result.reason();
  EXPECT_NEAR(result->p_low, 0.0511513262052, 1e-13);
  EXPECT_NEAR(result->p_high, 0.0692278305567, 1e-13);
  EXPECT_EQ(result->p, result->p_high);
  EXPECT_NEAR(result->interval.low, 0.719127628421, 1e-12);
  EXPECT_NEAR(result->interval.high, 0.932539038246, 1e-12);
}

TEST(Equivalence, HoldsExactlyWhenTheIntervalLiesWithin) {
  const Answer<TTest> test = CalcTTest({0.2, -0.1, 0.3, 0.05, -0.2, 0.1});
  const Interval inner = CalcEquivalence(test, {-1, 1})->interval;
  for (double margin : {-1e-6, 1e-6}) {
    const auto at_low = CalcEquivalence(test, {inner.low - margin, 1.0});
    const auto at_high = CalcEquivalence(test, {-1.0, inner.high + margin});
    EXPECT_EQ(at_low->p<0.05, margin> 0);
    EXPECT_EQ(at_high->p<0.05, margin> 0);
  }
}

}  // namespace
}  // namespace graspbench
