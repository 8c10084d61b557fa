#pragma once
/** @file
What settings change, as text for the terminal. */

#include <string>

#include "datasets/analysis/conditions/sensitivity_summary.h"

namespace graspbench {

/** One row per setting and hand. */
std::string FormatSensitivityTables(const SensitivitySummary& summary);

}  // namespace graspbench
