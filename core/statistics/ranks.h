#pragma once
/** @file
Ranks with ties, and the rank correlation of two measures of the same things. */

#include <vector>

#include "core/statistics/answer.h"

namespace graspbench {

struct Ranks {
  std::vector<int> twice;  ///< twice the rank, 1 is the smallest: average ranks are halves
  double tie_sum = 0.0;    ///< sum over groups of equal values of t^3 - t
};

/** Values within `tolerance` of their neighbour in order share the average rank. @pre no NaN. */
Ranks RankValues(const std::vector<double>& values, double tolerance = 0.0);

/** Spearman's rank correlation: Pearson's of the average ranks, which is right with ties, too.
C. Spearman, Am. J. Psychol. 15 (1904).
No answer below three pairs, when one side is all ties, or with a NaN. @pre equal sizes. */
Answer<double> CalcSpearman(const std::vector<double>& a, const std::vector<double>& b);

/** Area under the ROC curve: the share of pairs (one positive, one negative) in which the positive
one scores higher, ties half; Mann and Whitney's U over its largest value. 0.5 is chance.
No answer without a positive and a negative, or with a NaN. @pre equal sizes. */
Answer<double> CalcRocArea(const std::vector<double>& scores, const std::vector<bool>& is_positive);

}  // namespace graspbench
