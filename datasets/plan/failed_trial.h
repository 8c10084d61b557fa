#pragma once
/** @file
Prepares a session's failed trial for the search for remedies (core/trial/remedies.h). */

#include "core/trial/remedies.h"
#include "datasets/plan/session_plan.h"

namespace graspbench {

/** Trial number of the first fresh draw, beyond those of any session. */
inline constexpr int kFirstFreshDraw = 1000000;

/** Collects fresh draws of the trial's condition and the other grasps that the hand can perform on
its object. At full depth the rehearsed grasp comes first (rehearsed_grasps.h); it takes a second
where no earlier run has it.
@param setup  from MakeTrialSetup for this trial, with a complete object.
@returns a FailedTrial without the result. */
FailedTrial MakeFailedTrial(const SessionConfig& config, const SessionInputs& inputs,
                            const PlannedTrial& planned, const TrialSetup& setup,
                            ExplainDepth depth = ExplainDepth::kFull);

}  // namespace graspbench
