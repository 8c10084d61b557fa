#pragma once
/** @file
Ranks with ties, and rank correlations of two measures of the same items. */

#include <string>
#include <vector>

#include "core/statistics/answer.h"
#include "core/statistics/bootstrap.h"

namespace graspbench {

struct Ranks {
  std::vector<int> twice;  ///< twice the rank (1: smallest), because average ranks can be halves
  double tie_sum = 0.0;    ///< sum over groups of equal values of t^3 - t
};

/** Ranks values; neighbours in order that differ by at most `tolerance` share their average rank.
@pre no NaN. */
Ranks RankValues(const std::vector<double>& values, double tolerance = 0.0);

/** Spearman's rank correlation: Pearson's correlation of the average ranks, which is also valid
with ties. C. Spearman, Am. J. Psychol. 15 (1904). No answer below three pairs, if all values of one
side are tied, or with a NaN. @pre equal sizes. */
Answer<double> CalcSpearman(const std::vector<double>& a, const std::vector<double>& b);

/** Area under the ROC curve: the share of pairs (one positive, one negative) in which the positive
has the higher score, ties counted half. It is Mann and Whitney's U divided by its maximum; 0.5 is
chance. No answer without a positive and a negative, or with a NaN. @pre equal sizes. */
Answer<double> CalcRocArea(const std::vector<double>& scores, const std::vector<bool>& is_positive);

/** Two measures of the same items in one group, for the rank correlation within groups. It tells
whether a and b are correlated among otherwise similar items. Group means have no influence, so that
a difference between objects is not mistaken for an effect.

Within each group of n pairs both sides are replaced by their ranks (average ranks for ties),
centred and divided by n. Over all groups g

    rho = sum_g sum_i a_gi b_gi / sqrt(sum_g sum_i a_gi^2  sum_g sum_i b_gi^2)

A single group gives Spearman's correlation. The interval comes from resampling groups
(bootstrap.h), the p value from permuting one side within its groups:

    p = (1 + permutations with |rho| at least as large) / (1 + permutations)

This test keeps its level for any distributions, ties included (B. Phipson and G. K. Smyth, Stat.
Appl. Genet. Mol. Biol. 9 (2010)). */
struct PairedGroup {
  std::vector<double> a, b;
};

struct WithinCorrelation {
  int num_groups = 0;  ///< informative groups: at least three pairs, and neither side all tied
  int num_pairs = 0;   ///< in these groups
  double correlation = 0.0;
  Answer<Interval> interval;  ///< 95 %
  double p = 1.0;             ///< two-sided, of no correlation in any group
};

/** Computes the correlation within groups. Pairs with a NaN are excluded. No answer without an
informative group.
@param id  names the random stream.   @pre equal sizes in each group. */
Answer<WithinCorrelation> CalcWithinCorrelation(const std::vector<PairedGroup>& groups,
                                                const std::string& id, int num_shuffles = 1999);

}  // namespace graspbench
