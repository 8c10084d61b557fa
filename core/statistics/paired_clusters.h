#pragma once
/** @file
Success of two controllers on the same draws, where pairs of one object are alike: which of the two
succeeds more often, and how many pairs that takes.

Where the two are equal, each object's difference could as well have the other sign. So the test is
exact given the differences d_o (gained less lost pairs of object o): p is the share of all 2^k signs
with |sum of +-d_o| at least as large as it is (R. A. Fisher, "The design of experiments", 1935,
section 21; by counting sums, not by chance). Pairs of an object may depend on each other in any way.
With fewer than 6 objects no result is below 5 %.

How many pairs: with n pairs on k objects, of which a share q differ, the mean difference D has the
standard error sqrt((q - D^2) / n + s^2 / k), where s is the spread of the objects' true differences;
power is that of the two-sided t test with k - 1 degrees of freedom, which the exact one resembles,
of D less 1 / n: half a step of the sums, which the exact test gives away. */

#include <optional>
#include <vector>

#include "core/statistics/proportion.h"

namespace graspbench {

inline constexpr size_t kFewestClusters = 6;

/** p value, two-sided; 1 where nothing differs. @pre no count is negative. */
double CalcClusteredExactTwoSided(const std::vector<PairedCounts>& clusters);

struct PairedPlan {
  double difference = 0.1;   ///< of the success probabilities that is to be decided
  double discordance = 0.0;  ///< share of pairs that differ, at least |difference|
  double spread = 0.0;       ///< standard deviation of the difference between objects
  int num_clusters = 0;      ///< objects
};

/** Pairs, as many on each object, with which a share `power` of comparisons is decided at 5 %;
nullopt: more than a million, or too few objects. @pre 0 < difference <= 1. */
std::optional<int> CalcPairsNeeded(const PairedPlan& plan, double power = 0.8);

/** What pairs say of others like them: share that differ, and spread between objects by the method
of moments, 0 where chance explains it. */
PairedPlan EstimatePairedPlan(const std::vector<PairedCounts>& clusters, double difference);

}  // namespace graspbench
