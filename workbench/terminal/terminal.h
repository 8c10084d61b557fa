#pragma once
/** @file
The one way of the program to stdout and stderr: names and cells of foreign files pass through
EscapeForTerminal on it (core/base/text/text.h); tests/lint/check_output.cmake looks for others. */

#include <cstdio>
#include <string>
#include <string_view>

#include "core/base/error.h"
#include "core/base/text/json.h"

namespace graspbench {

/** What the user asked for: to stdout, as it is but for its escapes; the caller ends the lines. */
void PrintResult(std::string_view text);
/** A whole JSON value and a line feed on stdout; bytes that are no UTF-8 become U+FFFD. */
void PrintJson(const Json& json);
/** All other words: to stderr, with a line feed. */
void PrintMessage(std::string_view text);

/** @throws Error(kIo) when not all of the results reached stdout. */
void FlushResults();

/** Text with cursor movements of our own, for a progress block. @pre foreign parts are escaped. */
void PrintControlled(std::FILE* stream, std::string_view text);

/** Text of core/base/text/text.h for a terminal: no-break spaces become spaces. */
std::string MakePlainText(std::string text);

/** Problems of a checked file: [{severity, file, line, text}]; line is null when the file as a
whole is meant. */
Json MakeJson(const Diagnostics& problems);

/** One line each on stdout: they are what a check is asked for. */
void PrintFindings(const Diagnostics& problems);

/** " (2 errors, 1 warning)"; empty without findings. */
std::string FormatFindingCounts(const Diagnostics& problems);

}  // namespace graspbench
