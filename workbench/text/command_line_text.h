#pragma once
/** @file
The parser's commands and options, formatted for shell completion and for man. */

#include <string>
#include <vector>

namespace graspbench {

class Command;

/** Lists the supported shells: "bash", "zsh", "fish". */
std::vector<std::string> ListShells();

/** Formats a script that completes commands, options, short lists of values, and ids; otherwise
files.
@pre shell is one of ListShells(). */
std::string FormatCompletion(const Command& program, const std::string& shell);

/** Formats the man page graspbench.1. */
std::string FormatManPage(const Command& program);

}  // namespace graspbench
