#pragma once
/** @file
What a session's hands and objects must have for its grip, asked before it starts. */

#include "datasets/plan/session_config.h"
#include "datasets/plan/session_inputs.h"

namespace graspbench {

/** @throws Error(kRange) for a force that a drive of a hand cannot give in one of the session's
grasps, with the largest possible; power grasps are not asked (grip_limit.h holds for pads). */
void CheckGripForces(const SessionConfig& config, const SessionInputs& inputs);
/** @throws Error(kRange) for a margin with an object that has no friction. */
void CheckGripMargins(const SessionConfig& config, const SessionInputs& inputs);

}  // namespace graspbench
