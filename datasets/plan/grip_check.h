#pragma once
/** @file
What a session's hands and objects must have for its grip, asked before it starts. */

#include "datasets/plan/session_config.h"
#include "datasets/plan/session_inputs.h"

namespace graspbench {

/** @throws Error(kRange) for a force above the bound of a hand in one of the session's grasps, with
the largest possible (core/trial/grip/grip_limit.h). */
void CheckGripForces(const SessionConfig& config, const SessionInputs& inputs);
/** By sensed touch. @throws Error(kRange) for a force that a digit's elements do not feel: below the
detection threshold of one, or above what all of the digit together can feel. */
void CheckFeltForces(const SessionConfig& config, const SessionInputs& inputs);
/** Of hands whose pads give less than is asked in one of the session's grasps, by estimate; whose
elements feel one by one less than is asked, or nothing of the least that a margin asks. */
std::vector<std::string> ListGripWarnings(const SessionConfig& config, const SessionInputs& inputs);
/** @throws Error(kRange) for a margin with an object that has no friction. */
void CheckGripMargins(const SessionConfig& config, const SessionInputs& inputs);

}  // namespace graspbench
