#pragma once
/** @file
The one way of the program to stdout and stderr: names and cells of foreign files pass through
EscapeForTerminal on it (core/base/text/escape.h); tests/lint/check_output.cmake looks for others. */

#include <cstdio>
#include <string>
#include <string_view>

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

}  // namespace graspbench
