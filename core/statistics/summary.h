#pragma once
/** @file
Location and spread of one sample.

Sums of squares are computed about the mean in a second pass, corrected for the rounding of the
first one (Chan, Golub and LeVeque, "Algorithms for computing the sample variance", Am. Stat. 37
(1983)). So values with many identical leading digits keep their spread. */

#include <optional>
#include <vector>

#include "core/statistics/answer.h"

namespace graspbench {

struct Summary {
  int count = 0;        ///< number of values without the missing ones
  int num_missing = 0;  ///< NaN in the input
  double mean = 0.0;
  std::optional<double> standard_deviation;  ///< none for a single value
  double minimum = 0.0;
  double lower_quartile = 0.0;  ///< linear between order statistics (Hyndman and Fan 1996, type 7)
  double median = 0.0;
  double upper_quartile = 0.0;
  double maximum = 0.0;
};

/** Computes the summary. No answer without a finite value, or with an infinite one. */
Answer<Summary> CalcSummary(const std::vector<double>& values);

struct Moments {
  double mean = 0.0;
  double sum_of_squares = 0.0;  ///< about the mean
  /** The spread does not exceed the rounding error of the values: they are all equal. */
  bool is_constant = true;
};

/** Computes the moments. `scale` is the largest magnitude that the values were computed from, if it
exceeds their own: differences inherit the rounding error of their operands.
@pre at least one value, all finite. */
Moments CalcMoments(const std::vector<double>& values, double scale = 0.0);

/** Returns the plain sum divided by the count; NaN without values. */
double CalcMean(const std::vector<double>& values);

/** Returns the median: the type 7 quantile at 1/2, without a full sort. Infinite values are ordered
as usual; NaN without values. @pre no NaN among the values. */
double CalcMedian(std::vector<double> values);

/** Returns the median of the finite values. */
double CalcMedianOfFinite(std::vector<double> values);

/** Returns the type 7 quantile of sorted values. @pre not empty, 0 <= probability <= 1. */
double CalcSortedQuantile(const std::vector<double>& sorted, double probability);

}  // namespace graspbench
