#pragma once
/** @file
What replaying a session has found, for the terminal and as JSON. */

#include <string>

#include "core/base/text/json.h"
#include "workbench/experiments/replay_session.h"

namespace graspbench {

/** @param with_all  a line for each trial; else for those that are not as recorded. At the end how
many are, and whether physics, build or inputs are those of the session. */
std::string FormatReplay(const SessionReplay& replay, bool with_all);
Json MakeReplayJson(const SessionReplay& replay, const std::string& folder);

}  // namespace graspbench
