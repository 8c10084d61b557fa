#pragma once
/** @file
How reliable each measure of hand opening is in this study: the family side by side, on the same
trials, so that "more reliable than the aperture" is a number.

Conditions open the hand differently; that is no unreliability. So the mean of each condition is
taken away from its trials and the grand mean added, and all trials of a person count together. */

#include <string>
#include <vector>

#include "core/statistics/summary.h"
#include "human_study/events/hand_opening.h"
#include "human_study/statistics/reliability/reliability.h"

namespace graspbench {

struct StudyResult;

struct OpeningReliability {
  const HandOpening* opening = nullptr;
  Answer<Summary> open;           ///< largest opening of the trials, conditions taken out [m]
  double within_person_sd = NAN;  ///< [m]; also for one person, as the next two
  double within_person_cv = NAN;  ///< within_person_sd over the mean
  double minimal_detectable_change = NAN;  ///< [m]
  Answer<Reliability> reliability;
  int num_separated = 0;  ///< persons with a d'
  double d_prime = NAN;   ///< mean of theirs, open against closed hand
  /** ICC(1,1) minus that of the aperture, persons resampled. */
  Answer<BootstrapInterval> against_aperture;
  std::vector<PrecisionLoss> without_digit;  ///< in the order of StudyResult::digits
};

/** In the order of HandOpeningList(). */
std::vector<OpeningReliability> CalcOpeningReliability(const StudyResult& result);

}  // namespace graspbench
