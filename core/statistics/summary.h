#pragma once
/** @file
Location and spread of one sample.

Sums of squares are taken about the mean in a second pass with the rounding of the first removed
(Chan, Golub and LeVeque, "Algorithms for computing the sample variance", Am. Stat. 37 (1983)), so
that values with many constant leading digits keep their spread. */

#include <optional>
#include <vector>

#include "core/statistics/answer.h"

namespace graspbench {

struct Summary {
  int count = 0;        ///< of values
  int num_missing = 0;  ///< NaN in the input
  double mean = 0.0;
  std::optional<double> standard_deviation;  ///< none for a single value
  double minimum = 0.0;
  double lower_quartile = 0.0;  ///< linear between order statistics (Hyndman and Fan 1996, type 7)
  double median = 0.0;
  double upper_quartile = 0.0;
  double maximum = 0.0;
};

/** No answer without a finite value, or with an infinite one. */
Answer<Summary> CalcSummary(const std::vector<double>& values);

struct Moments {
  double mean = 0.0;
  double sum_of_squares = 0.0;  ///< about the mean
  /** The spread is no more than what rounding the values leaves behind: they are all equal. */
  bool is_constant = true;
};

/** @pre at least one value, all finite. `scale` is the largest magnitude the values were computed
from, when that is more than their own: differences inherit the rounding of what was subtracted. */
Moments CalcMoments(const std::vector<double>& values, double scale = 0.0);

/** Their plain sum over their number; NaN without values. */
double CalcMean(const std::vector<double>& values);

/** The middle of the values, half-way between the two in the middle of an even number: the type 7
quantile at 1/2, without sorting all. Infinite values keep their place; NaN without values.
@pre no NaN among the values. */
double CalcMedian(std::vector<double> values);

/** The same of the finite values alone. */
double CalcMedianOfFinite(std::vector<double> values);

/** Quantile of sorted values, type 7. @pre not empty, 0 <= probability <= 1. */
double CalcSortedQuantile(const std::vector<double>& sorted, double probability);

}  // namespace graspbench
