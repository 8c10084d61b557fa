#pragma once
/** @file
Summary of a session in a few lines: success per hand, failures by outcome, and the number of grips
that did not reach their setpoint. */

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

/** What remains: "3 trials are" (not run), else held grasps not judged yet if the judge was begun;
empty: nothing. */
std::string DescribeRest(const Session& session);

}  // namespace graspbench
