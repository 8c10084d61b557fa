#pragma once
/** @file
A sweep (datasets/plan/sweep_design.h) from its folder to its last trial: the trials of all
conditions, then what the judge and the bisections of grip thresholds ask for. */

#include "workbench/experiments/session_experiment.h"

namespace graspbench {

/** Runs what is left. @param scale  of the thresholds; null: none are looked for.
@returns whether nothing is left. @throws as PrepareThresholds. */
bool RunSweep(const PreparedSession& sweep, const ThresholdScale* scale, ExperimentRequest request,
              int num_workers, Observer& observer, const std::atomic<bool>& stop);

/** Processor time, from the first trial of each hand, for a person, in no result [s]. */
double EstimateSweepTime(const PreparedSession& sweep, bool with_judge, bool with_thresholds);

}  // namespace graspbench
