#pragma once
/** @file
The program's commands and options, as the parser knows them, for shells and for man. */

#include <string>
#include <vector>

namespace graspbench {

class Command;

/** "bash", "zsh", "fish". */
std::vector<std::string> ListShells();

/** A script that completes commands, options, their values where these are few, ids; else files.
@pre shell is one of ListShells(). */
std::string FormatCompletion(const Command& program, const std::string& shell);

/** graspbench.1, for man. */
std::string FormatManPage(const Command& program);

}  // namespace graspbench
