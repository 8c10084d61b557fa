#pragma once
/** @file
Group-sequential decision between an old and a new method, from trials of both on the same initial
poses. The new method is accepted as soon as a look at the data shows that it

    does not succeed more than 5 points less often     p_new - p_old > -0.05
    and is better by a goal in most pairs              P(better) > P(worse)

It is rejected after the last look. It is rejected earlier, to save trials, at a look at which its
success is below that margin by more than a standard error (z < -1) or it was not better in most
pairs.

After look k of K both tests require a normal deviate of C_K sqrt(K/k) (O'Brien and Fleming,
Biometrics 35, 1979). C_K for a one-sided 5 % over all looks is from Jennison and Turnbull, "Group
sequential methods with applications to clinical trials", 2000, table 2.3. Success is tested by
Tango's score for paired proportions (Stat. Med. 17, 1998), with c gained and b lost of n pairs and
m = 0.05:

    z = (c - b + n m) / sqrt(n (2 q - m (1 + m)))
    q = (sqrt(B^2 - 8 n C) - B) / (4 n),  B = -(b + c) - (2 n + b - c) m,  C = b m (1 + m)

The goal is tested by the exact sign test without ties. A method that is 5 points worse, or no
better by the goal, is accepted in at most some 5 % of decisions; early rejections only lower that.
tests/core/statistics contains the rates by simulation. */

#include "core/statistics/proportion.h"

namespace graspbench {

inline constexpr int kPairsPerLook = 20;
inline constexpr int kMostLooks = 5;
/** Margin by which the success probability of the new method may be lower. */
inline constexpr double kSuccessMargin = 0.05;

/** Results of the pairs so far. */
struct PairedEvidence {
  PairedCounts success;  ///< first: old
  int num_better = 0;    ///< pairs in which the new one is better by the goal
  int num_worse = 0;
};

enum class PairedDecision {
  kGoOn,
  kTaken,
  kSucceedsLess,  ///< rejected: fewer successes
  kIsNotBetter,   ///< rejected: not better by the goal
  kIsNotDecided,  ///< rejected: the last look did not show both
};

/** Returns z (above); larger values favour the new method. @pre at least one pair. */
double CalcNonInferiorityScore(const PairedCounts& success);

/** Decides after one look.
@param look  from 1 to num_looks.  @pre 1 <= num_looks <= kMostLooks; at least one pair. */
PairedDecision Decide(const PairedEvidence& evidence, int look, int num_looks);

}  // namespace graspbench
