#pragma once
/** @file
Grip thresholds of a session's draws: an experiment whose conditions are the grips of a scale and
which runs of every draw the trials that its bisection asks for
(datasets/analysis/conditions/threshold_summary.h), a round for each step of all bisections. */

#include "core/trial/grip/grip_threshold.h"
#include "workbench/experiments/session_experiment.h"

namespace graspbench {

/** Its folder, in which RunExperiment runs it; of a sweep, of all its conditions.
@throws as PrepareExperiment and ListThresholdGrips; Error(kRange) for a margin of an object without
friction, and for forces with touch: sensed of a hand that feels nothing. */
PreparedSession PrepareThresholds(const ExperimentRequest& request, const ThresholdScale& scale);

/** Of forces that the hands' pads hardly give (datasets/plan/grip_check.h). */
std::vector<std::string> ListThresholdWarnings(const PreparedSession& experiment,
                                               const ThresholdScale& scale);

}  // namespace graspbench
