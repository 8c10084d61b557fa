#include <memory>
#include <string>
#include <vector>

#include "core/base/files/files.h"
#include "datasets/analysis/export_result.h"
#include "datasets/session/ro_crate.h"
#include "datasets/session/session_store.h"
#include "workbench/command.h"
#include "workbench/experiments/output_folder.h"
#include "workbench/robot_export.h"

namespace graspbench {
namespace {

struct ExportOptions : RobotExport {
  std::vector<std::string> mjcf;  // ids of trials, or "all"
  bool with_urdf = false;         // neither of these: tables
  bool with_records = false;
  bool with_ro_crate = false;
  OnDamage on_damage = OnDamage::kRefuse;
};

void ExportTables(const ExportOptions& options, const Session& session) {
  const std::filesystem::path folder = options.out.empty() ? options.folder : options.out;
  if (options.out.empty()) {
    ExportResult(folder, session, options.with_records);
  } else {
    StagedFolder staged({folder, "export", options.replace, {options.folder}});
    ExportResult(staged.path(), session, options.with_records);
    staged.Commit();
  }
  if (options.with_ro_crate) {
    WriteFileAtomically(folder / "ro-crate-metadata.json", FormatRoCrate(folder));
  }
  const std::string table = (folder / "export" / "trials.csv").string();
  if (options.json) {
    return PrintJson({{"folder", options.folder},
                      {"table", table},
                      {"planned", session.plan.size()},
                      {"finished", session.records.size()}});
  }
  PrintResult(table + "\n");
}

void Export(const ExportOptions& options) {
  const Session session = LoadSession(options.folder, options.on_damage, RecordParts::kBrief);
  if (!session.damage.empty()) PrintMessage("damage accepted" + FormatDamage(session.damage));
  if (!session.findings.entries().empty()) PrintMessage(session.findings.Format());
  if (options.with_urdf) return ExportUrdf(options, session);
  options.mjcf.empty() ? ExportTables(options, session)
                       : ExportMjcf(options, options.mjcf, session);
}

}  // namespace

void AddExportCommand(Command& program) {
  Command& command =
      AddSubcommand(program, "export", "Write the trials of a session as CSV and SQLite.",
                    "  graspbench export results/benchmark-1a2b3c4d\n"
                    "  column -ts, \"$(graspbench export results/pilot)\" | less -S\n"
                    "  graspbench export results/pilot --mjcf all --out scenes");
  const auto options = std::make_shared<ExportOptions>();
  command.AddRequired("folder", options->folder, "folder of the session", "DIR");
  command
      .AddOption("--mjcf", options->mjcf,
                 "write scene and commanded motion of these trials for MuJoCo instead", "ID,..|all")
      ->SplitAtCommas();
  command
      .AddFlag("--urdf", options->with_urdf,
               "write a URDF of the session's robot arm with each of its hands instead")
      ->Excludes("--mjcf");
  command
      .AddOption("--out", options->out, "other folder, for example for a read-only session", "DIR")
      ->ShowDefault("that of the session");
  command.AddFlag("--records", options->with_records,
                  "also write records.jsonl: the complete record of each trial, one per line");
  Option* ro_crate =
      command.AddFlag("--ro-crate", options->with_ro_crate,
                      "also write ro-crate-metadata.json: contents and provenance, for archives");
  ro_crate->Excludes("--out")->Excludes("--mjcf")->Excludes("--urdf");
  AddReplaceOption(command, options->replace);
  AddJsonOption(command, options->json);
  AddAcceptDamageOption(command, options->on_damage);
  command.SetAction([options] { Export(*options); });
}

}  // namespace graspbench
