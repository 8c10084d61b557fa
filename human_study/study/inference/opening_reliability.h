#pragma once
/** @file
Is a measure of hand opening more reliable than the aperture? The family side by side, on the same
trials, by criteria that neither a constant added to a measure nor its unit changes. (The
coefficient of variation is none of them: a constant added to the mean wins it.)

With s the standard deviation of the largest opening within persons and conditions (pooled; for
d' of the open and the closed hand together):

    persons     sqrt(MS_P / MS_W), what ICC(1,1) = (F - 1) / (F + k - 1) is made of
    separation  d' = (open - closed) / s, mean of the persons' differences
    slope       b / s, mean of the persons' slopes over the first factor with numbers
    robustness  d' without the digit whose loss costs this measure most

`persons` takes the mean of each condition away from its trials first: conditions open the hand
differently, that is no unreliability.

A measure is compared with the aperture by the logarithm of the ratio of their criteria, persons
left out in turn (core/statistics/bootstrap.h), p values of the whole family adjusted after Holm.
The interval is of that one comparison. `slope` counts only when the aperture itself grows with the
factor: else nothing says which sign is better. Below kMinPersons nothing is tested. */

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
  const char* text;  ///< for people: "d' open, closed"
};
const std::array<OpeningCriterion, kNumOpeningCriteria>& ListOpeningCriteria();

/** Of one criterion, against the aperture on the same trials. */
struct OpeningComparison {
  double ratio = NAN;     ///< this measure's criterion / the aperture's; above 1 is better
  double low = NAN;       ///< 95 % interval of the ratio
  double high = NAN;      ///< as `low`
  double p = NAN;         ///< of a ratio of 1
  double p_holm = NAN;    ///< over all measures and criteria
  int num_persons = 0;    ///< compared
  std::string no_answer;  ///< why there is none; empty: there is one

  bool IsBetter() const { return p_holm < 0.05 && ratio > 1.0; }
  bool IsWorse() const { return p_holm < 0.05 && ratio < 1.0; }
};

enum class OpeningVerdict {
  kShown,        ///< better by one criterion or more, worse by none
  kNotShown,     ///< neither
  kWorse,        ///< worse by one or more, better by none
  kDivided,      ///< better by one, worse by another
  kNotTestable,  ///< no criterion could be tested
};

struct OpeningReliability {
  const HandOpening* opening = nullptr;
  Answer<Summary> open;           ///< largest opening of the trials, conditions taken out [m]
  double within_person_sd = NAN;  ///< SEM of one trial [m]; also for one person, as the next
  double minimal_detectable_change = NAN;  ///< [m]
  Answer<Reliability> reliability;
  std::array<Answer<double>, kNumOpeningCriteria> criteria;
  /** d' without each digit over d' with all, in the order of StudyResult::digits: 1 is no loss. */
  std::vector<Answer<double>> kept_without;
  /** Without use for the aperture itself. */
  std::array<OpeningComparison, kNumOpeningCriteria> against_aperture;

  OpeningVerdict verdict() const;
};

struct OpeningFamily {
  std::vector<OpeningReliability> rows;  ///< in the order of HandOpeningList()
  std::string slope_factor;              ///< of `slope`; empty: no factor has numbers
  int num_persons = 0;                   ///< with a kept trial
  int num_tests = 0;                     ///< of the family that Holm's adjustment went over
};

inline constexpr int kMinPersons = 5;

OpeningFamily CalcOpeningReliability(const StudyResult& result);

/** The argument in a sentence or two, with the intervals of the study's own opening: shown, not
shown, or not testable and why. @pre the statistics are there. */
std::string DescribeOpeningArgument(const StudyResult& result);

}  // namespace graspbench
