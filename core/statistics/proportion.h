#pragma once
/** @file
Proportions: the uncertainty of a success rate, and tests whether two rates differ.

Wilson interval at 95 % (z = 1.959964), with p = k/n:

    (p + z^2/2n +- z sqrt(p (1 - p)/n + z^2/4n^2)) / (1 + z^2/n)

Sources: E. B. Wilson, "Probable inference, the law of succession, and statistical inference", J.
Am. Stat. Assoc. 22 (1927); R. G. Newcombe, "Two-sided confidence intervals for the single
proportion", Stat. Med. 17 (1998), method 3, without continuity correction.

Difference of two proportions over the same n trials: a trials succeeded both times, b only the
first time, c only the second time, d never. With the Wilson limits l, u of p1 = (a + b)/n and p2 =
(a + c)/n:

    p2 - p1 - sqrt((p2 - l2)^2 - 2 phi (p2 - l2)(u1 - p1) + (u1 - p1)^2)      lower limit
    p2 - p1 + sqrt((u2 - p2)^2 - 2 phi (u2 - p2)(p1 - l1) + (p1 - l1)^2)      upper limit

phi is the correlation (a d - b c) / sqrt((a + b)(c + d)(a + c)(b + d)), where n/2 is subtracted
from a positive numerator, but not below 0. phi is 0 if a margin is empty. R. G. Newcombe, "Improved
confidence intervals for the difference between binomial proportions based on paired data", Stat.
Med. 17 (1998), method 10.

Fisher's exact test, two-sided: with fixed margins, the sum of the hypergeometric probabilities of
all tables that are at most as probable as the observed one (R. A. Fisher, "The design of
experiments", 1935). */

#include <cstdint>
#include <string>

namespace graspbench {

/** Returns count / num_all; NaN for 0 of 0. */
double CalcShare(int64_t count, int64_t num_all);

struct Interval {
  double low = 0.0;
  double high = 1.0;
};

/** Returns the 95 % interval of the success probability; [0, 1] without trials.
@pre 0 <= num_successes <= num_trials. */
Interval CalcWilsonInterval(int num_successes, int num_trials);

/** Counts of how the same trials ended under two conditions. */
struct PairedCounts {
  int both = 0;
  int first_only = 0;
  int second_only = 0;
  int neither = 0;

  void Add(bool is_first, bool is_second) {
    ++(is_first ? (is_second ? both : first_only) : (is_second ? second_only : neither));
  }
  int num_pairs() const { return both + first_only + second_only + neither; }
};
/** Returns the 95 % interval of the second success probability minus the first; [-1, 1] without
pairs.
@pre no count is negative. */
Interval CalcPairedDifferenceInterval(const PairedCounts& counts);

/** Returns the p value of "both succeed equally often" for pairs by McNemar's exact test,
two-sided. It is twice the tail of the binomial with probability 1/2 over the discordant pairs (Q.
McNemar, Psychometrika 12, 1947); 1 without discordant pairs. @pre no count is negative. */
double CalcMcNemarExactTwoSided(const PairedCounts& counts);

/** Returns the p value of "both have the same success probability" by Fisher's exact test; 1 if
either had no trials. The cost grows with the sum of the trials.
@pre as for CalcWilsonInterval, for both. */
double CalcFisherExactTwoSided(int num_successes_a, int num_trials_a, int num_successes_b,
                               int num_trials_b);

/** Formats a rate as it must be printed, with its counts and Wilson interval: "9 of 10 trials (90.0
%, 95 % interval 59.6 to 98.2 %)"; "0 of 0 trials" without trials. @pre as for
CalcWilsonInterval. */
std::string FormatRate(int num_successes, int num_trials);

/** Formats only the interval, in per cent: "59.6 to 98.2"; "n/a" without trials. */
std::string FormatRateInterval(int num_successes, int num_trials);

}  // namespace graspbench
