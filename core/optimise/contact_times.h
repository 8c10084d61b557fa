#pragma once
/** @file
GFT, GOT and GCT of learning trials in seconds, in addition to their ratios (grasp_optimiser.h),
since a ratio also falls if the closure only takes longer. The values are medians over the trials in
which every digit touched and none touched before the start of closure. Other trials have no times;
they are counted.

The floor of GFT [s] corresponds to that of GFT% (core/grasp/contact_timing.h). The times of each
digit are shifted by their own median, to the median of the last digit; then the median of GFT is
taken. The floor is due to the scatter of the digits between trials. */

#include <vector>

#include "core/base/units.h"
#include "core/optimise/learning_trial.h"

namespace graspbench {

struct ContactTimesSummary {
  int num_trials = 0, num_timed = 0;
  double gft = kUnset, got = kUnset, gct = kUnset;  ///< [s]; NaN: no trial has times
  double gft_floor = kUnset;  ///< [s]; NaN: fewer than kLeastTrialsOfFloor trials have times
};
ContactTimesSummary SummariseContactTimes(const std::vector<LearningTrial>& trials);

}  // namespace graspbench
