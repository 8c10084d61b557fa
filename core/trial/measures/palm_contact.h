#pragma once
/** @file
Whether the palm holds with the digits. */

#include "core/trial/trial_result.h"

namespace graspbench {

/** Whether the palm, or another link of no digit, touches the object when the trial ends. */
bool TouchesPalmAtEnd(const TrialResult& result);

}  // namespace graspbench
