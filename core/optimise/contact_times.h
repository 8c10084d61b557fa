#pragma once
/** @file
GFT, GOT and GCT of learning trials in seconds, beside their ratios (grasp_optimiser.h): a ratio
falls, too, where the closure only takes longer. Medians over the trials in which every digit touched
and none before the start of closure; the others have no times and are counted.

The floor of GFT [s] is that of GFT% (core/grasp/contact_timing.h) in seconds: each digit's times are
shifted by their own median, to the median of the digit that comes last; then the median of GFT. What
is left is how the digits scatter from trial to trial. */

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
