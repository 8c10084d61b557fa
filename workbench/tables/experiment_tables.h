#pragma once
/** @file
Results of experiments on the draws of a session, as text for the terminal. Short tables are defined
in the file of their command. */

#include <string>
#include <vector>

#include "datasets/analysis/conditions/delay_summary.h"
#include "datasets/analysis/conditions/numerics_summary.h"
#include "datasets/analysis/session_comparison.h"
#include "datasets/analysis/simultaneity_summary.h"

namespace graspbench {

/** One row per setting and hand. */
std::string FormatSensitivityTables(const SensitivitySummary& summary);

/** A table of the variants, and one of the flips when there are any. */
std::string FormatNumericsTables(const std::vector<NumericsSummary>& summaries,
                                 const std::vector<NumericsComparison>& comparisons);

/** One row a hand and response, one column a measure of simultaneity. */
std::string FormatRelations(const std::vector<SimultaneityRelation>& relations);

/** One row a condition, late digit, hand and response. */
std::string FormatDoseResponses(const std::vector<DoseResponse>& rows);

/** One row per cell, and what the bisections took. */
std::string FormatThresholdTables(const ThresholdSummary& summary);

/** One row per scale and hand; empty without any. */
std::string FormatThresholdChanges(const std::vector<ThresholdChange>& changes);

}  // namespace graspbench
