#pragma once
/** @file Grip thresholds, as text for the terminal. */

#include <string>
#include <vector>

#include "datasets/analysis/conditions/threshold_comparison.h"

namespace graspbench {

/** One row per cell, and what the bisections took. */
std::string FormatThresholdTables(const ThresholdSummary& summary);

/** One row per scale and hand; empty without any. */
std::string FormatThresholdChanges(const std::vector<ThresholdChange>& changes);

}  // namespace graspbench
