#include <CLI/CLI.hpp>

#include "core/trial/outcome.h"
#include "workbench/commands/command.h"

namespace graspbench {

void AddOutcomesCommand(CLI::App& program, ExitCode&) {
  CLI::App& command = AddSubcommand(program, "outcomes", "List what a trial can end with.",
                                    "  graspbench outcomes");
  command.callback([] {
    for (const Outcome outcome : ListOutcomes()) PrintResult(std::string(NameOf(outcome)) + "\n");
  });
}

}  // namespace graspbench
