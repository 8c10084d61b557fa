#pragma once
/** @file
Whether an arm stands free where every trial begins. */

#include <string>

#include "core/arm/mounted_arm.h"

namespace graspbench {

/** What the arm touches in its ready posture, of the table and itself; empty: nothing. "link 3
would meet the table". */
std::string FindReadyCollision(const MountedArm& mounted);

}  // namespace graspbench
