#pragma once
/** @file
The largest force that the drives of a hand can press with in a grasp. */

#include "core/grasp/standard_grasp.h"

namespace graspbench {

/** Of the weakest digit that does not oppose the others, at its pad in the target posture, along
the pad's way there [N]: the drive that reaches its torque limit first decides. Infinite where
closing moves no pad. Real contacts lie elsewhere on the digit, so this is an estimate. */
double CalcLargestGrip(const Hand& hand, const Grasp& grasp);

}  // namespace graspbench
