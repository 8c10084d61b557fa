#pragma once
/** @file
A command adds itself to the program: its options, and a callback that does the work and leaves the
exit code. Faults are thrown as Error; program.cc prints them and chooses the exit code.

Results go to stdout, messages and progress to stderr. `--json` prints one object. */

#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/base/json.h"

namespace CLI {
class App;
}

namespace graspbench {

#define GRASPBENCH_COMMAND(Name) void Add##Name##Command(CLI::App& program, ExitCode& exit_code);
#include "workbench/commands/command_list.inc"
#undef GRASPBENCH_COMMAND

/** Adds a subcommand whose help starts with `examples`, one indented line each. */
CLI::App& AddSubcommand(CLI::App& parent, const std::string& name, const std::string& description,
                        const std::string& examples);

/** Options that several commands share. */
///@{
/** A list in one word: "--object can,cup". */
void AddListOption(CLI::App& command, const std::string& name, std::vector<std::string>& list,
                   const std::string& text, const std::string& form);
/** "--hand" and "--object". */
void AddSceneOptions(CLI::App& command, std::vector<std::string>& hands,
                     std::vector<std::string>& objects);
/** "--set KEY=VALUE", again and again. */
void AddSettingsOption(CLI::App& command, std::vector<std::string>& settings,
                       const std::string& example);
/** "--jobs": sets num_workers to the number of processors, unless told otherwise. */
void AddJobsOption(CLI::App& command, int& num_workers, const std::string& what = "trials");
///@}

/** A whole JSON value and a line feed on stdout. */
void PrintJson(const Json& json);

}  // namespace graspbench
