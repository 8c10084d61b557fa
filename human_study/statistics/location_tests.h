#pragma once
/** @file
t tests of one value per person: against a number, between two conditions, and for equivalence.

    t = (mean - reference) / (s / sqrt(n)),   df = n - 1,   d_z = (mean - reference) / s

(d_z: Cohen, "Statistical power analysis for the behavioral sciences", 1988, section 2.3.5). */

#include <vector>

#include "core/statistics/answer.h"
#include "core/statistics/proportion.h"
#include "human_study/statistics/measure_table.h"

namespace graspbench {

struct TTest {
  int count = 0;        ///< persons with a value (for pairs, in both conditions)
  int num_missing = 0;  ///< persons without a value
  double mean = 0.0;    ///< of the values, or of the differences a - b
  double standard_deviation = 0.0;
  double reference = 0.0;
  double t = 0.0;
  double df = 0.0;
  double p = 1.0;     ///< two-sided
  Interval interval;  ///< of the mean, 95 %
  double d_z = 0.0;
};

/** Tests one value per person against a reference. NaN is missing. No answer below two values, with
an infinite one, or when all values are equal. */
Answer<TTest> CalcTTest(const std::vector<double>& values, double reference = 0.0);

/** Tests the differences a - b of the same persons in the same order; a person missing in either is
left out. No answer as above. @pre equal sizes. */
Answer<TTest> CalcPairedTTest(const std::vector<double>& a, const std::vector<double>& b);

/** Test of a - b between two groups of persons with unequal variances, one value per person (B. L.
Welch, Biometrika 34 (1947)). */
struct WelchTest {
  int count_a = 0, count_b = 0;  ///< persons with a value
  double difference = 0.0;
  double standard_error = 0.0;
  double t = 0.0;
  double df = 0.0;    ///< Satterthwaite's
  double p = 1.0;     ///< two-sided
  Interval interval;  ///< of the difference, 95 %
  double d_s = 0.0;   ///< difference / pooled standard deviation
};

/** NaN is missing. No answer below two values in a group, with an infinite one, or when neither
group has any spread. */
Answer<WelchTest> CalcWelchTest(const std::vector<double>& a, const std::vector<double>& b);

/** Two one-sided tests of whether the mean lies within the bounds (Schuirmann, "A comparison of the
two one-sided tests procedure ..", J. Pharmacokinet. Biopharm. 15 (1987)). */
struct EquivalenceTest {
  Interval bounds;
  double t_low = 0.0, p_low = 1.0;    ///< against mean <= bounds.low
  double t_high = 0.0, p_high = 1.0;  ///< against mean >= bounds.high
  double p = 1.0;                     ///< the larger of the two
  Interval interval;                  ///< 90 %: inside the bounds exactly when p < 0.05
};

/** Tests for equivalence. No answer where the t test has none, or unless bounds.low < bounds.high.
@param bounds  the largest irrelevant difference, from knowledge of the field, not from the data. */
Answer<EquivalenceTest> CalcEquivalence(const Answer<TTest>& test, Interval bounds);

/** Rank tests, for skewed or bounded measures.

Wilcoxon's signed-rank test is exact: its distribution is that of all 2^n sign assignments to the
observed ranks, ties included (average ranks). Pairs without a difference are left out, as by
Wilcoxon (Biometrics Bull. 1 (1945)), and counted.

Friedman's test is his chi-squared with the correction for ties (J. Am. Stat. Assoc. 32 (1937);
Conover, "Practical nonparametric statistics", 3rd ed. 1999, section 5.8); the approximation is poor
below about 10 persons and 3 conditions.

Differences equal up to rounding (8 units in the last place of the largest value) are ties. */
struct WilcoxonTest {
  int count = 0;        ///< pairs that differ
  int num_zeros = 0;    ///< pairs without a difference
  int num_missing = 0;  ///< persons missing in either condition
  bool has_ties = false;
  double w_plus = 0.0;  ///< sum of the ranks of positive differences a - b
  double w_minus = 0.0;
  double p = 1.0;              ///< exact, two-sided: twice the smaller tail, at most 1
  double rank_biserial = 0.0;  ///< (w_plus - w_minus) / (w_plus + w_minus), in [-1, 1]
};

/** Tests a - b of the same persons in the same order; NaN is missing. No answer without a pair that
differs, with an infinite value or above 1000 pairs. @pre equal sizes. */
Answer<WilcoxonTest> CalcWilcoxon(const std::vector<double>& a, const std::vector<double>& b);

struct FriedmanTest {
  int num_persons = 0;
  double chi_squared = 0.0;
  double df = 0.0;
  double p = 1.0;
  double kendall_w = 0.0;          ///< agreement between the persons, 0 to 1
  std::vector<double> mean_ranks;  ///< per condition; 1 is the smallest value
};

/** Tests all conditions as one factor. No answer below two persons or two conditions, or when all
values are tied. */
Answer<FriedmanTest> CalcFriedman(const CellMeans& cells);

}  // namespace graspbench
