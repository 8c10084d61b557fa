#pragma once
/** @file
The end of a session in a few lines: success per hand, what the failures were, and how many grips
did not reach what was asked. */

#include <filesystem>
#include <string>

#include "core/base/text/json.h"
#include "datasets/analysis/session_summary.h"

namespace graspbench {

/** A table for the terminal, with a line feed after each row. */
std::string FormatSummaryTable(const SessionSummary& summary);

/** {session, report, hands: [{hand, trials, successes, outcomes}]}. */
Json MakeSummaryJson(const SessionSummary& summary, const std::filesystem::path& folder,
                     const std::filesystem::path& report);

/** "3 trials are": not run, or else not judged where somebody has begun to judge; empty: none. */
std::string DescribeRest(const Session& session);

}  // namespace graspbench
