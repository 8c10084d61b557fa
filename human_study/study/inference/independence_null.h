#pragma once
/** @file
Are people more simultaneous than digits that move independently would be?

A digit that moves on its own keeps its habits but knows nothing of the others in the same trial.
Such digits are made from the study itself: the contact times of each digit are permuted among
the trials of one person and condition, each digit on its own, and GFT and GFT% are taken again.
Habits (the thumb first by 40 ms) stay; what digits share within a trial is lost. The p value is the
share of 999 dealings at least as extreme, two-sided, from a stream that the study's trials name.

Times must be counted from something in the trial, and what all digits share with that clock makes
them look simultaneous. So three clocks are asked, and the one that speaks least for a difference
decides:

    onset     seconds since the movement's onset
    widest    seconds since the widest opening, the start of closure
    movement  the same as onset, less what the length of the movement says of that digit (a
              straight line within each person): slow and fast movements make nobody simultaneous

An error of the clock is shared by all digits of a trial, too, and would be taken for coordination.
How much of the spread it is lies between nothing and what the clock's stated uncertainty (and what
the contacts share) says. So there are two sets of independent digits: with the spread of each
digit's times within person and condition reduced by that variance, and with all of it. More
simultaneous is who is so against the first; less, who is so against the second; who lies between is
told from neither.

Stated uncertainties do not cover how profiles differ between trials, so three agreeing clocks are
not enough for "more simultaneous": what the digits share must also exceed a bound of the clock's
error found from the movements themselves (CalcSharedTiming). Else the verdict is "not decided".

Only trials in which all digits of the study touched take part. */

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "core/statistics/bootstrap.h"

namespace graspbench {

/* How much the touches of one trial's digits share beyond what the hand's transport explains, and
whether that is more than an error of the clock could be.

All touches of a trial are counted from one event of the hand, so an error of that event is shared
by all digits exactly as coordination is. Differences between digits are free of it, and of
coordination. So the error is made small and bounded:

    times     t_d - r, the touch of digit d less the instant r at which the wrist rose through 10 %
              of its peak speed
    adjusted  for how fast the wrist rose further (10 to 30 %, 30 to 60 %) and how far it went, by
              regression over all trials: what a profile or a distance does to r or to the touches
              is no coordination of the digits
    neighbours differences between successive trials of a person in a condition, less their mean,
              so that a steady drift of all digits is none either. Times that wander step by step
              (a random walk) leave half the squared step; but then the difference to the next trial
              does not take back the one before, as it does by half where trials share by
              themselves: from that product alone (`alternating_sd`) nothing is shared
    shared    variance of the digits' mean, less what digits on their own leave in it
    clock     the variance that r keeps: noise where it crosses, and half of what r varies about
              the start that the profile extrapolates to (Movement::start) within person and
              condition: the regression is trusted with half of it

Assumed: the profile's first part is a power of time; coordination does not follow the profile or
the distance (if it does it is not counted). */

/** One trial as the hand and its digits tell it. */
struct SharedTimingTrial {
  std::vector<double> contacts;   ///< of each digit [s]
  double shared_variance = 0.0;   ///< of the errors that all contacts share [s^2]
  double clock = NAN;             ///< the wrist rose through 10 % of its peak speed [s]
  double clock_noise = 0.0;       ///< standard uncertainty of that by noise [s]
  double start = NAN;             ///< extrapolated [s]; NaN: not known
  std::vector<double> transport;  ///< rise times, distance; as many in every trial, may be none
};
/** Successive trials of one person in one condition. */
using SharedTimingRun = std::vector<SharedTimingTrial>;

struct SharedTiming {
  double shared_sd = NAN;      ///< of what the digits share; 0 when less than nothing [s]
  double shared_low_sd = NAN;  ///< at least this, with 95 % [s]
  double clock_sd = NAN;       ///< bound of the clock's error [s]
  /** The same spread from what one difference takes back of the one before; imprecise [s]. */
  double alternating_sd = NAN;
  double df = NAN;  ///< of the variance of the digits' mean

  /** More is shared than the clock's error can be, and it does not wander from trial to trial. */
  bool IsShown() const { return shared_low_sd > clock_sd && alternating_sd > clock_sd; }
};

/** @param runs  each of three trials or more. No answer with fewer than 5 degrees of freedom. */
Answer<SharedTiming> CalcSharedTiming(const std::vector<SharedTimingRun>& runs);

struct StudyTrial;
struct StudyResult;

inline constexpr size_t kNumClocks = 3;
/** "onset", "widest", "movement". */
const std::array<const char*, kNumClocks>& ListClocks();

/** One measure against what independent digits would show: those of less spread when people lie
below them, else those of all their spread. */
struct IndependenceTest {
  double observed = NAN;         ///< mean over the trials, in the measure's unit, as `expected`
  double expected = NAN;         ///< mean over trials and dealings
  double low = NAN, high = NAN;  ///< 95 % of the dealings' means; of both sets where between them
  double p = NAN;                ///< two-sided; 1 between the two sets
  /** A mean smaller by this share of `expected` is found in 8 of 10 such studies. */
  double detectable = NAN;
  /** Logarithm of observed / expected over persons, each person one value. None below five. */
  Answer<JackknifeInterval> over_persons = NoAnswer{"not calculated"};
};

enum class IndependenceVerdict {
  kMore,  ///< simultaneous than independent digits
  kLess,
  kNotDecided,    ///< clocks disagree, or what digits share may be the clock's error
  kNoDifference,  ///< by no clock
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
  int num_trials = 0;                                  ///< that take part
  int num_incomplete = 0;                              ///< kept, but a digit did not touch
  int num_persons = 0;                                 ///< who take part
  std::array<IndependenceTest, kNumClocks> gft;        ///< [s]
  std::array<IndependenceTest, kNumClocks> gft_ratio;  ///< GFT / GCT
  Answer<SharedTiming> shared = NoAnswer{"not calculated"};

  IndependenceVerdict Judge(const std::array<IndependenceTest, kNumClocks>& tests) const;

  /** The clock that speaks least for a difference: the largest p where all clocks agree in sign,
  else the one that speaks most against "more simultaneous". */
  static size_t FindStrictest(const std::array<IndependenceTest, kNumClocks>& tests);
};

/** No answer with fewer than two digits, or when there are so few trials of a person in a condition
that no permutation could exclude chance. */
Answer<IndependenceNull> CalcIndependenceNull(const std::vector<StudyTrial>& trials,
                                              size_t num_digits);

/** The verdict in a sentence: more simultaneous, less, or not decided. */
std::string SayIndependence(const Answer<IndependenceNull>& null);
/** With numbers of the strictest clock, and power. */
std::string DescribeIndependence(const Answer<IndependenceNull>& null);

}  // namespace graspbench
