#include "human_study/statistics/location_tests.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/random.h"
#include "core/statistics/distributions.h"
#include "tests/human_study/statistics/known_studies.h"

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

TEST(Wilcoxon, AgreesWithTheNagExample) {
  const Answer<WilcoxonTest> test =
      CalcWilcoxon({82, 69, 73, 43, 58, 56, 76, 65}, {63, 42, 74, 37, 51, 43, 80, 62});
  ASSERT_TRUE(test) << test.reason();
  EXPECT_EQ(test->w_plus, 32.0);
  EXPECT_EQ(test->w_minus, 4.0);
  EXPECT_EQ(test->p, 14.0 / 256.0);  // 0.0547
  EXPECT_FALSE(test->has_ties);
  EXPECT_DOUBLE_EQ(test->rank_biserial, 28.0 / 36.0);
}

/** All 2^n signs on the ranks of the differences. */
double EnumerateP(const std::vector<double>& differences) {
  const size_t n = differences.size();
  std::vector<double> ranks;
  for (double own : differences) {
    double rank = 0.5;
    for (double other : differences) {
      rank += std::abs(other) < std::abs(own) ? 1.0 : std::abs(other) == std::abs(own) ? 0.5 : 0.0;
    }
    ranks.push_back(rank);
  }
  const auto sum_ranks = [&](size_t signs) {
    double sum = 0.0;
    for (size_t i = 0; i < n; ++i) sum += (signs >> i & 1) ? ranks[i] : 0.0;
    return sum;
  };
  size_t observed = 0;
  for (size_t i = 0; i < n; ++i) observed |= size_t{differences[i] > 0.0} << i;
  double low = 0.0, high = 0.0;
  for (size_t signs = 0; signs < (size_t{1} << n); ++signs) {
    low += sum_ranks(signs) <= sum_ranks(observed);
    high += sum_ranks(signs) >= sum_ranks(observed);
  }
  return std::min(1.0, 2.0 * std::min(low, high) / std::pow(2.0, static_cast<double>(n)));
}

TEST(Wilcoxon, AgreesWithCountingAllSigns) {
  RandomStream random("wilcoxon", "test");
  for (int k = 0; k < 200; ++k) {
    std::vector<double> differences;
    const int n = 1 + random.NextIndex(9);
    for (int i = 0; i < n; ++i) {
      // Small whole numbers: many ties.
      const double size = 1.0 + random.NextIndex(k % 2 == 0 ? 4 : 1000);
      differences.push_back(random.NextUnit() < 0.3 ? -size : size);
    }
    const auto test = CalcWilcoxon(differences, std::vector<double>(differences.size(), 0.0));
    ASSERT_TRUE(test) << test.reason();
    EXPECT_NEAR(test->p, EnumerateP(differences), 1e-14);
  }
}

TEST(Wilcoxon, LeavesOutZerosAndTheMissing) {
  const auto plain = CalcWilcoxon({1, 2, 3, 5}, {0, 0, 0, 9});
  const auto more = CalcWilcoxon({1, 7, 2, 3, std::nan(""), 5}, {0, 7, 0, 0, 1, 9});
  EXPECT_EQ(more->num_zeros, 1);
  EXPECT_EQ(more->num_missing, 1);
  EXPECT_EQ(more->count, 4);
  EXPECT_EQ(more->p, plain->p);
}

TEST(Wilcoxon, DifferencesEqualButForRoundingAreTies) {
  const auto test = CalcWilcoxon({0.3, 0.7, 0.9, 0.5}, {0.1, 0.5, 0.7, 0.5});
  EXPECT_TRUE(test->has_ties);
  EXPECT_EQ(test->num_zeros, 1);
  EXPECT_EQ(test->p, 0.25);
}

TEST(Wilcoxon, HoldsForMany) {
  std::vector<double> a, b;
  for (int i = 0; i < 1000; ++i) {
    a.push_back(i + 1.0);
    b.push_back(i % 2 == 0 ? 0.0 : 2.0 * (i + 1.0));
  }
  const auto test = CalcWilcoxon(a, b);
  ASSERT_TRUE(test);
  EXPECT_GT(test->p, 0.9);  // signs alternate
  a.push_back(7.5);
  b.push_back(0.0);
  EXPECT_EQ(CalcWilcoxon(a, b).reason(), "1001 pairs; expected at most 1000");
}

TEST(Wilcoxon, GivesReasons) {
  EXPECT_EQ(CalcWilcoxon({}, {}).reason(), "none of 0 pairs has a difference");
  EXPECT_EQ(CalcWilcoxon({1, 2}, {1, 2}).reason(), "none of 2 pairs has a difference");
  EXPECT_EQ(CalcWilcoxon({INFINITY}, {INFINITY}).reason(), "a value is infinite");
}

CellMeans MakeCells(const Eigen::MatrixXd& means) {
  CellMeans cells;
  cells.means = means;
  return cells;
}

TEST(Friedman, AgreesWithR) {
  const auto test = CalcFriedman(MakeCells(MakeReachMeans()));
  ASSERT_TRUE(test) << test.reason();
  EXPECT_NEAR(test->chi_squared, 24.0, 1e-12);
  EXPECT_NEAR(test->p, 2.498e-05, 5e-9);
  EXPECT_NEAR(test->kendall_w, 1.0, 1e-12);
  EXPECT_EQ(test->mean_ranks, (std::vector<double>{1, 2, 3, 4}));
}

TEST(Friedman, AgreesWithROnTies) {
  Eigen::MatrixXd means(5, 3);
  means << 1, 2, 2, 3, 1, 2, 2, 2, 3, 1, 3, 2, 1, 2, 3;
  const auto test = CalcFriedman(MakeCells(means));
  EXPECT_NEAR(test->chi_squared, 2.777777778, 5e-10);
  EXPECT_NEAR(test->p, 0.249352209, 5e-10);
  // Only the order within a person matters.
  Eigen::MatrixXd monotone = means.array().exp();
  monotone.row(1).array() += 100.0;
  EXPECT_NEAR(CalcFriedman(MakeCells(monotone))->chi_squared, test->chi_squared, 1e-12);
}

TEST(Friedman, GivesReasons) {
  EXPECT_EQ(CalcFriedman(MakeCells(MakeReachMeans().topRows(1))).reason(),
            "1 person; expected 2 or more");
  EXPECT_EQ(CalcFriedman(MakeCells(MakeReachMeans().leftCols(1))).reason(),
            "one condition: nothing to compare");
  EXPECT_EQ(CalcFriedman(MakeCells(Eigen::MatrixXd::Constant(3, 3, 0.1))).reason(),
            "no person has different values: all are tied");
}

}  // namespace

}  // namespace graspbench
