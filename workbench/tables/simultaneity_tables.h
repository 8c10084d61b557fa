#pragma once
/** @file
What simultaneity and the lack of it go with, as text for the terminal. */

#include <string>
#include <vector>

#include "datasets/analysis/conditions/delay_summary.h"
#include "datasets/analysis/simultaneity_summary.h"

namespace graspbench {

/** One row a hand and response, one column a measure of simultaneity. */
std::string FormatRelations(const std::vector<SimultaneityRelation>& relations);

/** One row a condition, late digit, hand and response. */
std::string FormatDoseResponses(const std::vector<DoseResponse>& rows);

}  // namespace graspbench
