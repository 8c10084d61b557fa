#pragma once
/** @file
Comparison of the success of two controllers on the same initial poses, where pairs of one object
are correlated: a test for which controller succeeds more often, and the number of pairs it needs.

If both controllers are equal, each object's difference is equally likely to have the opposite sign.
So the test is exact given the differences d_o (pairs of object o gained minus lost). p is the share
of all 2^k sign assignments with |sum of +-d_o| at least as large as observed (R. A. Fisher, "The
design of experiments", 1935, section 21). It is computed by counting sums, not by sampling. Pairs
of one object may depend on each other in any way. With fewer than 6 objects no p value is below 5
%.

Number of pairs: take n pairs on k objects, a share q of them discordant, and let s be the standard
deviation of the objects' true differences. The mean difference D has the standard error sqrt((q -
D^2) / n + s^2 / k). The power is that of the two-sided t test with k - 1 degrees of freedom, which
approximates the exact test, for the difference D - 1 / n. The term 1 / n is half a step of the
sums, which the discreteness of the exact test costs. */

#include <optional>
#include <vector>

#include "core/statistics/proportion.h"

namespace graspbench {

inline constexpr size_t kFewestClusters = 6;

/** Returns the two-sided p value; 1 without discordant pairs. @pre no count is negative. */
double CalcClusteredExactTwoSided(const std::vector<PairedCounts>& clusters);

struct PairedPlan {
  double difference = 0.1;   ///< difference of the success probabilities to be detected
  double discordance = 0.0;  ///< share of discordant pairs, at least |difference|
  double spread = 0.0;       ///< standard deviation of the difference between objects
  int num_clusters = 0;      ///< objects
};

/** Returns the total number of pairs, equally many per object, for a share `power` of comparisons
to be significant at 5 %. nullopt: more than a million, or too few objects. @pre 0 < difference <=
1. */
std::optional<int> CalcPairsNeeded(const PairedPlan& plan, double power = 0.8);

/** Estimates the share of discordant pairs from observed pairs, and the spread between objects by
the method of moments (0 if chance explains it). */
PairedPlan EstimatePairedPlan(const std::vector<PairedCounts>& clusters, double difference);

}  // namespace graspbench
