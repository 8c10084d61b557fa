#include <CLI/CLI.hpp>
#include <memory>

#include "datasets/session/session_store.h"
#include "workbench/commands/command.h"

namespace graspbench {

void AddExportCommand(CLI::App& program, ExitCode&) {
  CLI::App& command =
      AddSubcommand(program, "export", "Write the trials of a session as CSV and SQLite.",
                    "  graspbench export results/benchmark-1a2b3c4d\n"
                    "  column -ts, \"$(graspbench export results/pilot)\" | less -S");
  const auto folder = std::make_shared<std::string>();
  command.add_option("folder", *folder, "folder of the session")->required()->option_text("DIR");
  command.callback([folder] {
    const Session session = LoadSession(*folder);
    if (!session.findings.entries().empty()) PrintMessage(session.findings.Format());
    ExportSession(*folder, session);
    PrintResult((std::filesystem::path(*folder) / "export" / "trials.csv").string() + "\n");
  });
}

}  // namespace graspbench
