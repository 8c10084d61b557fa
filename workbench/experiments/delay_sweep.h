#pragma once
/** @file
A session's first trials of each cell again, on their own draws, with one digit delayed
(datasets/analysis/conditions/delay_summary.h), the object as it was, lighter, more slippery and
farther from
where the hand expects it. Late is the digit that touched last without delay, which makes the
contacts less simultaneous by the delay, or the one that touched first, which makes them more so
until it is the last. */

#include <vector>

#include "datasets/analysis/conditions/delay_summary.h"
#include "workbench/experiments/session_experiment.h"

namespace graspbench {

/** The object's other states and, under each of them and as run, every delay of either digit. */
std::vector<Condition> ListDelayConditions(const SessionConfig& config);

/** Its folder, in which RunExperiment runs it. @throws as PrepareExperiment. */
PreparedSession PrepareDelays(const ExperimentRequest& request);

/** Of what is finished. Trials without two digits that touch have no delayed ones.
@pre the records are whole. */
std::vector<DelayedTrial> ListDelayedTrials(const Session& experiment);

}  // namespace graspbench
