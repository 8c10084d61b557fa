#pragma once
/** @file
Text of a failed trial's mechanism: the same in terminal, page, report and CSV. */

#include <string>

#include "core/trial/trial_result.h"

namespace graspbench {

/** Formats the event, then forces and works: "Squeezed out during closure at 1.850 s. ..". Empty
without a diagnosis. */
std::string DescribeDiagnosis(const TrialResult& result);

}  // namespace graspbench
