#pragma once
/** @file
The result of workbench/experiments/numerics_check.h as tables for the terminal. */

#include <string>
#include <vector>

#include "workbench/experiments/numerics_check.h"

namespace graspbench {

/** A table of the variants, and one of the flips when there are any. */
std::string FormatNumericsTables(const std::vector<NumericsSummary>& summaries,
                                 const std::vector<NumericsComparison>& comparisons);

}  // namespace graspbench
