#pragma once
/** @file
The page of a sweep: its conditions, a map for two factors (one for each level of a third), what each
level changes and which levels do not simply add up. */

#include <string>

#include "datasets/analysis/sweep_summary.h"

namespace graspbench {

/** A self-contained page like the session's report. */
std::string MakeSweepPage(const Session& session, const SweepSummary& summary);

}  // namespace graspbench
