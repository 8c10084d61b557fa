#pragma once
/** @file
The words for a failed trial's mechanism: the same for terminal, page, report and CSV. */

#include <string>

#include "core/trial/trial_result.h"

namespace graspbench {

/** "Squeezed out during closure at 1.850 s. ..": what happened, then forces and works. Empty
without a diagnosis. */
std::string DescribeDiagnosis(const TrialResult& result);

}  // namespace graspbench
