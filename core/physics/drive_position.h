#pragma once
/** @file
The coordinate that a joint's drive acts on: its position, and that of the joint which follows it
where the middle joint moves first (CouplingRule::kMiddleFirst). */

#include "core/physics/world.h"

namespace graspbench {

/** @param joint  index into Hand::joints.   @returns [rad], of a prismatic joint [m]. */
double CalcDrivePosition(const Hand& hand, const WorldState& state, int joint);

}  // namespace graspbench
