#pragma once
/** @file
What a sweep found, as text for the terminal. */

#include <string>

#include "datasets/analysis/conditions/sweep_summary.h"

namespace graspbench {

/** Conditions, effects, and the interactions whose interval excludes 0. */
std::string FormatSweepTables(const SweepSummary& summary);

}  // namespace graspbench
