#pragma once
/** @file
Tests whether people's contacts are more simultaneous than those of independently moving digits.

An independent digit keeps its habits but is uncorrelated with the others in the same trial. Such
digits are made from the study itself: the contact times of each digit are permuted separately among
the trials of one person and condition, and GFT and GFT% are computed again. Habits (the thumb first
by 40 ms) remain; variation shared by the digits within a trial is lost. The two-sided p value is
the share of 999 permutations at least as extreme. The random stream is seeded by the study's
trials.

Times must be measured from an event in the trial, and variation of this clock, shared by all
digits, makes them look simultaneous. So three clocks are used, and the one with the least evidence
for a difference decides:

    onset     seconds since the movement's onset
    widest    seconds since the widest opening, the start of closure
    movement  as onset, minus the prediction for the digit from the movement duration (a straight
              line within each person), so that variation of speed does not count as simultaneity

An error of the clock is also shared by all digits of a trial and would be mistaken for
coordination. Its variance lies between zero and that of the clock's stated uncertainty plus the
contacts' shared uncertainty. So there are two sets of independent digits: one whose variance of
contact times within person and condition is reduced by this bound, and one with the full variance.
"More simultaneous" requires a difference from the first set, "less simultaneous" one from the
second; between the two sets there is no significant difference.

Stated uncertainties do not cover differences of profiles between trials, so agreement of the three
clocks does not suffice for "more simultaneous". The shared variation of the digits must also exceed
a bound of the clock's error that is estimated from the movements themselves (CalcSharedTiming).
Else the verdict is "not decided".

Only trials in which all digits of the study touched are used. */

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "core/statistics/bootstrap.h"

namespace graspbench {

/* Variation that the contacts of one trial share beyond the part explained by the hand's transport,
and whether it exceeds a possible error of the clock.

All contacts of a trial are timed from one event of the hand, so an error of that event is shared by
all digits, exactly as coordination is. Differences between digits contain neither. So the error is
reduced and bounded:

    times     t_d - r, the contact of digit d minus the instant r at which the rising wrist speed
              crossed 10 % of its peak
    adjusted  for the further rise times of the wrist speed (10 to 30 %, 30 to 60 %) and the
              distance covered, by regression over all trials: effects of profile or distance on
              r or on the contacts are not coordination of the digits
    neighbours differences between successive trials of a person in a condition, minus their mean,
              so that a steady drift of all digits does not count either. A random walk of the times
              contributes half the squared step. But then successive differences are uncorrelated,
              while independent variation of trials reverses half of each difference in the next:
              estimated from this product (`alternating_sd`), a random walk gives nothing shared
    shared    variance of the digits' mean, minus the contribution of independent digits
    clock     the remaining variance of r: noise at the crossing, and half of the variance of r
              about the extrapolated start of the profile (Movement::start) within person and
              condition; the regression is assumed to remove the other half

Assumptions: the initial profile is a power of time; coordination is uncorrelated with the profile
and the distance (correlated coordination is not counted). */

/** Timing data of one trial. */
struct SharedTimingTrial {
  std::vector<double> contacts;   ///< by digit [s]
  double shared_variance = 0.0;   ///< variance of errors common to all contacts [s^2]
  double clock = NAN;             ///< the rising wrist speed crossed 10 % of its peak [s]
  double clock_noise = 0.0;       ///< standard uncertainty of `clock` due to noise [s]
  double start = NAN;             ///< extrapolated [s]; NaN: unknown
  std::vector<double> transport;  ///< rise times, distance; same number in all trials, may be 0
};
/** Successive trials of one person in one condition. */
using SharedTimingRun = std::vector<SharedTimingTrial>;

struct SharedTiming {
  double shared_sd = NAN;      ///< SD shared by the digits; 0 for a negative variance [s]
  double shared_low_sd = NAN;  ///< lower 95 % bound of shared_sd [s]
  double clock_sd = NAN;       ///< bound of the clock's error, as SD [s]
  /** shared_sd estimated from the product of successive differences; imprecise [s]. */
  double alternating_sd = NAN;
  double df = NAN;  ///< of the variance of the digits' mean

  /** Whether the shared variation exceeds the clock's error and is not a drift from trial to
  trial. */
  bool IsShown() const { return shared_low_sd > clock_sd && alternating_sd > clock_sd; }
};

/** Computes the shared variation. No answer with fewer than 5 degrees of freedom. @param runs  of
at least three trials each. */
Answer<SharedTiming> CalcSharedTiming(const std::vector<SharedTimingRun>& runs);

struct StudyTrial;
struct StudyResult;

inline constexpr size_t kNumClocks = 3;
/** "onset", "widest", "movement". */
const std::array<const char*, kNumClocks>& ListClocks();

/** One measure compared with independent digits: with the reduced-variance set when people lie
below it, else with the full-variance set. */
struct IndependenceTest {
  double observed = NAN;         ///< mean over the trials, in the measure's unit, as `expected`
  double expected = NAN;         ///< mean over trials and permutations
  double low = NAN, high = NAN;  ///< 95 % range of permutations' means; of both sets if between
  double p = NAN;                ///< two-sided; 1 between the two sets
  /** Reduction of the mean, as a share of `expected`, that is detected with a power of 0.8. */
  double detectable = NAN;
  /** Logarithm of observed / expected over persons, with one value per person. None below five
  persons. */
  Answer<JackknifeInterval> over_persons = NoAnswer{"not calculated"};
};

enum class IndependenceVerdict {
  kMore,  ///< simultaneous than independent digits
  kLess,
  kNotDecided,    ///< clocks disagree, or the clock's error may explain the result
  kNoDifference,  ///< with no clock
};
struct IndependenceVerdictRow {
  IndependenceVerdict value;
  const char* name;  ///< in statistics.csv
};
inline constexpr IndependenceVerdictRow kIndependenceVerdicts[] = {
    {IndependenceVerdict::kMore, "more simultaneous"},
    {IndependenceVerdict::kLess, "less simultaneous"},
    {IndependenceVerdict::kNotDecided, "not decided"},
    {IndependenceVerdict::kNoDifference, "no difference"}};

struct IndependenceNull {
  int num_trials = 0;      ///< used
  int num_incomplete = 0;  ///< included in the study, but a digit did not touch
  int num_persons = 0;     ///< with trials used
  std::array<IndependenceTest, kNumClocks> gft;        ///< [s]
  std::array<IndependenceTest, kNumClocks> gft_ratio;  ///< GFT / GCT
  Answer<SharedTiming> shared = NoAnswer{"not calculated"};

  IndependenceVerdict Judge(const std::array<IndependenceTest, kNumClocks>& tests) const;

  /** Returns the clock with the least evidence for a difference: the one with the largest p when
  all clocks agree in sign, else the one most opposed to "more simultaneous". */
  static size_t FindStrictest(const std::array<IndependenceTest, kNumClocks>& tests);
};

/** No answer with fewer than two digits, or when persons have too few trials per condition for any
permutation result to be significant. */
Answer<IndependenceNull> CalcIndependenceNull(const std::vector<StudyTrial>& trials,
                                              size_t num_digits);

/** States the verdict in a sentence: more simultaneous, less, or not decided. */
std::string SayIndependence(const Answer<IndependenceNull>& null);
/** Describes the result with the numbers of the strictest clock and the power. */
std::string DescribeIndependence(const Answer<IndependenceNull>& null);

}  // namespace graspbench
