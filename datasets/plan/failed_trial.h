#pragma once
/** @file
What it takes to ask a failed trial of a session further (core/trial/remedies.h). */

#include "core/trial/remedies.h"
#include "datasets/plan/session_plan.h"

namespace graspbench {

/** The number of the first fresh draw: beyond those of any session. */
inline constexpr int kFirstFreshDraw = 1000000;

/** Fresh draws of the trial's condition, and the other grasps that the hand can do on its object; in
full the rehearsed one first (rehearsed_grasps.h), which takes a second where no earlier run has it.
@param setup  of MakeTrialSetup for it, its object complete.   @returns without the result. */
FailedTrial MakeFailedTrial(const SessionConfig& config, const SessionInputs& inputs,
                            const PlannedTrial& planned, const TrialSetup& setup,
                            ExplainDepth depth = ExplainDepth::kFull);

}  // namespace graspbench
