#pragma once
/** @file
A command adds itself to the program: its options, and a callback that does the work and leaves the
exit code. Faults are thrown as Error; program.cc prints them and chooses the exit code.

Results go to stdout, messages and progress to stderr. `--json` prints one object. */

#include <string>

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

/** A whole JSON value and a line feed on stdout. */
void PrintJson(const Json& json);

}  // namespace graspbench
