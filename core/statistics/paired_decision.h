#pragma once
/** @file
A decision between an old and a new way of doing something, by trials of both on the same draws, a
look at a time: the new one is taken as soon as it is shown

    not to succeed more than 5 points less often     p_new - p_old > -0.05
    and to be better by a goal in most pairs         P(better) > P(worse)

and given up after the last look, or at a look at which its success is below that margin by more than
a standard error (z < -1) or it was not better in most pairs: it is then unlikely to be taken, and
trials are dear.

After k of K looks both tests ask for a normal deviate of C_K sqrt(K/k) (O'Brien and Fleming,
Biometrics 35, 1979; C_K for a one-sided 5 % over all looks as in Jennison and Turnbull, "Group
sequential methods with applications to clinical trials", 2000, table 2.3). Success is tested by
Tango's score for paired proportions (Stat. Med. 17, 1998), with c gained and b lost of n pairs and
m = 0.05:

    z = (c - b + n m) / sqrt(n (2 q - m (1 + m)))
    q = (sqrt(B^2 - 8 n C) - B) / (4 n),  B = -(b + c) - (2 n + b - c) m,  C = b m (1 + m)

the goal by the exact sign test without ties. A way that is 5 points worse, or as good by the goal,
is so taken in at most some 5 % of decisions; early ends only lower that. tests/core/statistics has
the rates by simulation. */

#include "core/statistics/proportion.h"

namespace graspbench {

inline constexpr int kPairsPerLook = 20;
inline constexpr int kMostLooks = 5;
/** By which the new one may succeed less often. */
inline constexpr double kSuccessMargin = 0.05;

/** What the pairs say so far. */
struct PairedEvidence {
  PairedCounts success;  ///< old first
  int num_better = 0;    ///< pairs in which the new one is better by the goal
  int num_worse = 0;
};

enum class PairedDecision {
  kGoOn,
  kTaken,
  kSucceedsLess,  ///< given up: successes were lost
  kIsNotBetter,   ///< given up: the goal was missed
  kIsNotDecided,  ///< both looked well, and the last look did not show it
};

/** z above; larger speaks for the new one. @pre at least one pair. */
double CalcNonInferiorityScore(const PairedCounts& success);

/** @param look  from 1 to num_looks.  @pre 1 <= num_looks <= kMostLooks; pairs are there. */
PairedDecision Decide(const PairedEvidence& evidence, int look, int num_looks);

}  // namespace graspbench
