#pragma once
/** @file
The pages of the manual that the program itself knows best, as Markdown: made from the
parser, the tables of keys, the columns and the outcomes, so that they cannot fall behind. */

#include <string>

namespace graspbench {

class Command;

/** Every command's help. */
std::string MakeCommandReference(const Command& program);
/** Every file that a person writes: its keys with unit, range, default and meaning. */
std::string MakeFileReference();
/** Every column of the tables of sessions and of a study's statistics. */
std::string MakeColumnReference();
/** Outcomes of trials, exit codes, presets. */
std::string MakeOutcomeReference();

}  // namespace graspbench
