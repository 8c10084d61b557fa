#pragma once
/** @file
Problems of a checked file, for a person and for a program. */

#include <string>

#include "core/base/diagnostics.h"
#include "core/base/text/json.h"

namespace graspbench {

/** [{severity, file, line, text}]; line is null when the file as a whole is meant. */
Json MakeJson(const Diagnostics& problems);

/** One line each on stdout: they are what a check is asked for. */
void PrintFindings(const Diagnostics& problems);

/** " (2 errors, 1 warning)"; empty without findings. */
std::string FormatFindingCounts(const Diagnostics& problems);

}  // namespace graspbench
