#pragma once
/** @file
Ranks with ties, and the rank correlation of two measures of the same things. */

#include <string>
#include <vector>

#include "core/statistics/answer.h"
#include "core/statistics/bootstrap.h"

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

/** Rank correlation inside groups: does a go with b among things that are alike otherwise? Means
of the groups play no part, so that a difference between objects is not taken for an effect.

Within each group of n pairs both sides get ranks R (ties halved), centred and divided by n; over
all groups g

    rho = sum_g sum_i a_gi b_gi / sqrt(sum_g sum_i a_gi^2  sum_g sum_i b_gi^2)

One group alone gives Spearman's correlation. The interval comes from drawing groups (bootstrap.h),
the p value from shuffling one side inside its groups:

    p = (1 + shuffles with |rho| at least as large) / (1 + shuffles)

which keeps its level whatever the distributions, ties included (B. Phipson and G. K. Smyth, Stat.
Appl. Genet. Mol. Biol. 9 (2010)).

Two measures of the same things. */
struct PairedGroup {
  std::vector<double> a, b;
};

struct WithinCorrelation {
  int num_groups = 0;  ///< that say something: three pairs or more, and neither side all ties
  int num_pairs = 0;   ///< in them
  double correlation = 0.0;
  Answer<Interval> interval;  ///< 95 %
  double p = 1.0;             ///< two-sided, of no relation in any group
};

/** Pairs with a NaN are left out. No answer when no group says anything.
@param id  names the random stream.   @pre equal sizes in each group. */
Answer<WithinCorrelation> CalcWithinCorrelation(const std::vector<PairedGroup>& groups,
                                                const std::string& id, int num_shuffles = 1999);

}  // namespace graspbench
