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
error found from the movements themselves (shared_timing.h). Else the verdict is "not decided".

Only trials in which all digits of the study touched take part. */

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "core/statistics/jackknife.h"
#include "human_study/study/inference/shared_timing.h"

namespace graspbench {

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
