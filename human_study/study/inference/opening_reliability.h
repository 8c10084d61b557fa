#pragma once
/** @file
Tests whether measures of hand opening are more reliable than the aperture. All measures are
compared on the same trials, by criteria that are invariant to an added constant and to the unit.
(The coefficient of variation is not: an added constant improves it.)

Let s be the pooled standard deviation of the largest opening within persons and conditions (for d',
of the open and the closed hand together):

    persons     sqrt(MS_P / MS_W), from which ICC(1,1) = (F - 1) / (F + k - 1) follows
    separation  d' = (open - closed) / s, mean of the persons' differences
    slope       b / s, mean of the persons' slopes over the first factor with numbers
    robustness  d' without the digit whose loss costs this measure most

For `persons`, the mean of each condition is first subtracted from its trials, because differences
between conditions are not unreliability.

A measure is compared with the aperture by the logarithm of the ratio of their criteria, with a
jackknife over persons (core/statistics/bootstrap.h). The p values of the whole family are adjusted
by Holm's method; intervals are unadjusted. `slope` is only tested when the aperture itself
increases with the factor, since otherwise the better sign is undefined. Below kMinPersons nothing
is tested. */

#include <array>
#include <string>
#include <vector>

#include "core/statistics/bootstrap.h"
#include "core/statistics/summary.h"
#include "human_study/events/hand_opening.h"
#include "human_study/statistics/reliability/reliability.h"

namespace graspbench {

struct StudyResult;

inline constexpr size_t kNumOpeningCriteria = 4;

struct OpeningCriterion {
  const char* id;
  const char* text;  ///< display name: "d' open, closed"
};
const std::array<OpeningCriterion, kNumOpeningCriteria>& ListOpeningCriteria();

/** Comparison with the aperture by one criterion, on the same trials. */
struct OpeningComparison {
  double ratio = NAN;     ///< this measure's criterion / the aperture's; above 1 is better
  double low = NAN;       ///< 95 % interval of the ratio
  double high = NAN;      ///< as `low`
  double p = NAN;         ///< for the null value 1
  double p_holm = NAN;    ///< over all measures and criteria
  int num_persons = 0;    ///< compared
  std::string no_answer;  ///< why there is no answer; empty: there is one

  bool IsBetter() const { return p_holm < 0.05 && ratio > 1.0; }
  bool IsWorse() const { return p_holm < 0.05 && ratio < 1.0; }
};

enum class OpeningVerdict {
  kShown,        ///< better by at least one criterion, worse by none
  kNotShown,     ///< neither
  kWorse,        ///< worse by at least one, better by none
  kDivided,      ///< better by one, worse by another
  kNotTestable,  ///< no criterion could be tested
};

struct OpeningReliability {
  const HandOpening* opening = nullptr;
  Answer<Summary> open;           ///< largest opening of the trials, adjusted for conditions [m]
  double within_person_sd = NAN;  ///< SEM of one trial [m]; like the next, also for one person
  double minimal_detectable_change = NAN;  ///< [m]
  Answer<Reliability> reliability;
  std::array<Answer<double>, kNumOpeningCriteria> criteria;
  /** d' without each digit over d' with all, in the order of StudyResult::digits; 1: no loss. */
  std::vector<Answer<double>> kept_without;
  /** Unused for the aperture itself. */
  std::array<OpeningComparison, kNumOpeningCriteria> against_aperture;

  OpeningVerdict verdict() const;
};

struct OpeningFamily {
  std::vector<OpeningReliability> rows;  ///< in the order of HandOpeningList()
  std::string slope_factor;              ///< of `slope`; empty: no factor has numbers
  int num_persons = 0;                   ///< with an included trial
  int num_tests = 0;                     ///< size of the family in Holm's adjustment
};

inline constexpr int kMinPersons = 5;

OpeningFamily CalcOpeningReliability(const StudyResult& result);

/** States the result in a sentence or two, with the intervals of the study's own opening: shown,
not shown, or not testable and why. @pre the statistics are computed. */
std::string DescribeOpeningArgument(const StudyResult& result);

}  // namespace graspbench
