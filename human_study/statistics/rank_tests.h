#pragma once
/** @file
Tests from ranks alone, for measures that are skewed or bounded.

Wilcoxon's signed-rank test is exact: its distribution is that of all 2^n signs on the ranks that
occurred, ties included (average ranks). Pairs without a difference are left out, as Wilcoxon did
(Biometrics Bull. 1 (1945)), and counted.

Friedman's test is his chi-squared with the correction for ties (J. Am. Stat. Assoc. 32 (1937);
Conover, "Practical nonparametric statistics", 3rd ed. 1999, section 5.8); an approximation that is
rough below about 10 persons and 3 conditions.

Differences that agree but for rounding (8 units in the last place of the largest value) are ties.
*/

#include <vector>

#include "human_study/statistics/measure_table.h"

namespace graspbench {

struct WilcoxonTest {
  int count = 0;        ///< pairs that differ
  int num_zeros = 0;    ///< pairs that do not
  int num_missing = 0;  ///< persons missing on either side
  bool has_ties = false;
  double w_plus = 0.0;  ///< sum of the ranks of positive differences a - b
  double w_minus = 0.0;
  double p = 1.0;              ///< exact, two-sided: twice the smaller tail, at most 1
  double rank_biserial = 0.0;  ///< (w_plus - w_minus) / (w_plus + w_minus), in [-1, 1]
};

/** a - b of the same persons in the same order; NaN is missing. @pre equal sizes.
No answer without a pair that differs, with an infinite value or above 1000 pairs. */
Answer<WilcoxonTest> CalcWilcoxon(const std::vector<double>& a, const std::vector<double>& b);

struct FriedmanTest {
  int num_persons = 0;
  double chi_squared = 0.0;
  double df = 0.0;
  double p = 1.0;
  double kendall_w = 0.0;          ///< agreement of the persons, 0 to 1
  std::vector<double> mean_ranks;  ///< per cell, 1 is the smallest value
};

/** All cells as one factor. No answer below two persons or two cells, or when all are tied. */
Answer<FriedmanTest> CalcFriedman(const CellMeans& cells);

}  // namespace graspbench
