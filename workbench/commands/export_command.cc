#include <CLI/CLI.hpp>
#include <memory>
#include <string>

#include "datasets/session/session_store.h"
#include "workbench/commands/command.h"
#include "workbench/experiments/output_folder.h"

namespace graspbench {
namespace {

struct ExportOptions {
  std::string folder;
  std::string out;  ///< empty: the session's own folder
  bool replace = false;
  bool with_records = false;
  OnDamage on_damage = OnDamage::kRefuse;
};

void Export(const ExportOptions& options) {
  const Session session = LoadSession(options.folder, options.on_damage, RecordParts::kBrief);
  if (!session.damage.empty()) PrintMessage("damage accepted" + FormatDamage(session.damage));
  if (!session.findings.entries().empty()) PrintMessage(session.findings.Format());
  const std::filesystem::path folder = options.out.empty() ? options.folder : options.out;
  if (options.out.empty()) {
    ExportSession(folder, session, options.with_records);
  } else {
    StagedFolder staged({folder, "export", options.replace, {options.folder}});
    ExportSession(staged.path(), session, options.with_records);
    staged.Commit();
  }
  PrintResult((folder / "export" / "trials.csv").string() + "\n");
}

}  // namespace

void AddExportCommand(CLI::App& program, ExitCode&) {
  CLI::App& command =
      AddSubcommand(program, "export", "Write the trials of a session as CSV and SQLite.",
                    "  graspbench export results/benchmark-1a2b3c4d\n"
                    "  column -ts, \"$(graspbench export results/pilot)\" | less -S");
  const auto options = std::make_shared<ExportOptions>();
  command.add_option("folder", options->folder, "folder of the session")
      ->required()
      ->option_text("DIR");
  command.add_option("--out", options->out, "folder for a session that cannot be written")
      ->option_text("DIR")
      ->default_str("that of the session");
  command.add_flag("--records", options->with_records,
                   "also records.jsonl: everything, a line a trial, as the journals hold it");
  AddReplaceOption(command, options->replace);
  AddAcceptDamageOption(command, options->on_damage);
  command.callback([options] { Export(*options); });
}

}  // namespace graspbench
