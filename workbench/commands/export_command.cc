#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>

#include "datasets/mjcf/mjcf_export.h"
#include "datasets/session/session_inputs.h"
#include "datasets/session/session_store.h"
#include "workbench/commands/command.h"

namespace graspbench {
namespace {

/** The trials meant by an id or its beginning, or by "all". */
std::vector<PlannedTrial> FindTrials(const Session& session, const std::string& name) {
  std::vector<PlannedTrial> found;
  for (const PlannedTrial& planned : session.plan) {
    if (name == "all" || planned.id.rfind(name, 0) == 0) found.push_back(planned);
  }
  if (found.empty() || name.empty()) {
    throw Error(ErrorKind::kNotFound, "the session has no trial \"" + name +
                                          "\"; expected the beginning of an id in the column "
                                          "trial_id of export/trials.csv, or all");
  }
  return found;
}

void ExportMjcf(const std::filesystem::path& folder, const Session& session,
                const std::string& name) {
  const std::vector<PlannedTrial> trials = FindTrials(session, name);
  const SessionInputs inputs = LoadSessionInputs(session.config);
  CheckSameSession(session, session.config, MakePlan(session.config, inputs));
  MjcfExporter exporter;
  for (const PlannedTrial& planned : trials) {
    const std::filesystem::path trial_folder = folder / "export" / "mjcf" / planned.id;
    exporter.Export(MakeTrialSetup(session.config, inputs, planned), trial_folder);
    std::cout << (trial_folder / "scene.xml").string() << '\n';
  }
}

}  // namespace

void AddExportCommand(CLI::App& program, ExitCode&) {
  CLI::App& command =
      AddSubcommand(program, "export", "Writes the trials of a session as CSV and SQLite.",
                    "  graspbench export results/benchmark-1a2b3c4d\n"
                    "  column -ts, \"$(graspbench export results/pilot)\" | less -S\n"
                    "  graspbench export results/pilot --mjcf all");
  const auto folder = std::make_shared<std::string>();
  const auto mjcf = std::make_shared<std::string>();
  command.add_option("folder", *folder, "folder of the session")->required()->option_text("DIR");
  CLI::Option* option =
      command.add_option("--mjcf", *mjcf, "instead: scene and commanded motion of a trial")
          ->option_text("TRIAL|all");
  command.callback([folder, mjcf, option] {
    const Session session = LoadSession(*folder);
    if (!session.findings.entries().empty()) std::cerr << session.findings.Format() << '\n';
    if (option->count() > 0) return ExportMjcf(*folder, session, *mjcf);
    ExportSession(*folder, session);
    std::cout << (std::filesystem::path(*folder) / "export" / "trials.csv").string() << '\n';
  });
}

}  // namespace graspbench
