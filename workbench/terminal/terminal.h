#pragma once
/** @file
The program's only access to stdout and stderr. Names and cells from files of others pass through
EscapeForTerminal (core/base/text/text.h). tests/lint/check_output.cmake rejects other output. */

#include <cstdio>
#include <string>
#include <string_view>

#include "core/base/error.h"
#include "core/base/text/json.h"

namespace graspbench {

/** Prints a result to stdout, unchanged except for escape sequences; the caller ends the lines. */
void PrintResult(std::string_view text);
/** Prints a JSON value and a line feed to stdout; bytes that are not valid UTF-8 become U+FFFD. */
void PrintJson(const Json& json);
/** Prints any other text to stderr, with a line feed. */
void PrintMessage(std::string_view text);

/** @throws Error(kIo) when the results could not be written to stdout completely. */
void FlushResults();

/** Prints text with our own cursor movements, for a progress block. @pre text from files is
escaped. */
void PrintControlled(std::FILE* stream, std::string_view text);

/** Converts text of core/base/text/text.h for a terminal: no-break spaces become spaces. */
std::string MakePlainText(std::string text);

/** Problems of a checked file: [{severity, file, line, text}]; line is null when the problem
concerns the whole file. */
Json MakeJson(const Diagnostics& problems);

/** Prints one line per problem to stdout, since the problems are the result of a check. */
void PrintFindings(const Diagnostics& problems);

/** " (2 errors, 1 warning)"; empty without findings. */
std::string FormatFindingCounts(const Diagnostics& problems);

}  // namespace graspbench
