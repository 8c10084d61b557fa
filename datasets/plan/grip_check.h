#pragma once
/** @file
What a session's hands and objects must have for its grip, asked before it starts. */

#include "datasets/plan/session_config.h"
#include "datasets/plan/session_inputs.h"

namespace graspbench {

/** @throws Error(kRange) for a force that no drive of a hand can give in one of its grasps, with the
largest possible. */
void CheckGripForces(const SessionConfig& config, const SessionInputs& inputs);
/** @throws Error(kRange) for a margin with an object that has no friction. */
void CheckGripMargins(const SessionConfig& config, const SessionInputs& inputs);

}  // namespace graspbench
