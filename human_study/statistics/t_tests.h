#pragma once
/** @file
t tests of one value per person: against a number, between two conditions, and for equivalence.

    t = (mean - reference) / (s / sqrt(n)),   df = n - 1,   d_z = (mean - reference) / s

(d_z: Cohen, "Statistical power analysis for the behavioral sciences", 1988, section 2.3.5). */

#include <vector>

#include "core/statistics/answer.h"
#include "core/statistics/proportion.h"

namespace graspbench {

struct TTest {
  int count = 0;        ///< persons with a value (in both conditions)
  int num_missing = 0;  ///< persons without
  double mean = 0.0;    ///< of the values, or of the differences a - b
  double standard_deviation = 0.0;
  double reference = 0.0;
  double t = 0.0;
  double df = 0.0;
  double p = 1.0;     ///< two-sided
  Interval interval;  ///< of the mean, 95 %
  double d_z = 0.0;
};

/** One value a person against a reference. NaN is missing.
No answer below two values, with an infinite one, or when all values are equal. */
Answer<TTest> CalcTTest(const std::vector<double>& values, double reference = 0.0);

/** Differences a - b of the same persons in the same order; a person missing on either side is left
out. @pre equal sizes. No answer as above. */
Answer<TTest> CalcPairedTTest(const std::vector<double>& a, const std::vector<double>& b);

/** Two groups of persons, one value a person, whose spread may differ (B. L. Welch, Biometrika 34
(1947)); a - b. */
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

/** NaN is missing. No answer below two values in a group, with an infinite one, or when the values
of both groups are equal among themselves. */
Answer<WelchTest> CalcWelchTest(const std::vector<double>& a, const std::vector<double>& b);

/** Two one-sided tests: is the mean surely within the bounds? (Schuirmann, "A comparison of the two
one-sided tests procedure ..", J. Pharmacokinet. Biopharm. 15 (1987)). */
struct EquivalenceTest {
  Interval bounds;
  double t_low = 0.0, p_low = 1.0;    ///< against mean <= bounds.low
  double t_high = 0.0, p_high = 1.0;  ///< against mean >= bounds.high
  double p = 1.0;                     ///< the larger of the two
  Interval interval;                  ///< 90 %: inside the bounds exactly when p < 0.05
};

/** @param bounds  the largest difference that would not matter, from the field, not from the data.
No answer where the t test has none, or unless bounds.low < bounds.high. */
Answer<EquivalenceTest> CalcEquivalence(const Answer<TTest>& test, Interval bounds);

}  // namespace graspbench
