#include <fmt/format.h>

#include <memory>
#include <set>
#include <string>
#include <vector>

#include "core/base/files/files.h"
#include "core/trial/trial_runner.h"
#include "datasets/analysis/export_result.h"
#include "datasets/mjcf/mjcf_export.h"
#include "datasets/plan/session_inputs.h"
#include "datasets/session/find_trial.h"
#include "datasets/session/ro_crate.h"
#include "datasets/session/session_store.h"
#include "workbench/command.h"
#include "workbench/experiments/output_folder.h"

namespace graspbench {
namespace {

struct ExportOptions {
  std::string folder;
  std::string out;                // empty: the session's own folder
  std::vector<std::string> mjcf;  // ids of trials, or "all"; empty: tables
  bool replace = false, json = false;
  bool with_records = false;
  bool with_ro_crate = false;
  OnDamage on_damage = OnDamage::kRefuse;
};

/** The trials that are asked for, in the plan's order. */
std::vector<PlannedTrial> FindTrials(const Session& session,
                                     const std::vector<std::string>& names) {
  if (names == std::vector<std::string>{"all"}) return session.plan;
  std::set<std::string> wanted;
  for (const std::string& name : names) wanted.insert(FindPlannedTrial(session, name).id);
  std::vector<PlannedTrial> found;
  for (const PlannedTrial& planned : session.plan) {
    if (wanted.count(planned.id) > 0) found.push_back(planned);
  }
  return found;
}

/** A folder a trial, named by its id; the path of each scene is printed. */
void ExportMjcf(const ExportOptions& options, const Session& session) {
  const std::vector<PlannedTrial> trials = FindTrials(session, options.mjcf);
  const SessionInputs inputs = LoadSessionInputs(session.config, FieldUse::kNow, session.folder);
  CheckSameSession(session, session.config, MakePlan(session.config, inputs));
  const bool is_own = options.out.empty();  // below export/, which is written again
  const std::filesystem::path folder =
      std::filesystem::path(is_own ? options.folder + "/export/mjcf" : options.out);
  StagedFolder staged({folder, "mjcf", options.replace || is_own, {options.folder}});
  MjcfExporter exporter;
  std::vector<std::string> scenes;
  for (const PlannedTrial& planned : trials) {
    exporter.Export(ChooseGraspBySight(MakeRecordedSetup(session, inputs, planned)),
                    staged.path() / planned.id);
    scenes.push_back((folder / planned.id / "scene.xml").string());
  }
  staged.Commit();
  if (options.json) return PrintJson({{"folder", options.folder}, {"scenes", scenes}});
  PrintResult(fmt::format("{}\n", fmt::join(scenes, "\n")));
}

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
  options.mjcf.empty() ? ExportTables(options, session) : ExportMjcf(options, session);
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
      .AddOption("--out", options->out, "other folder, for example for a read-only session", "DIR")
      ->ShowDefault("that of the session");
  command.AddFlag("--records", options->with_records,
                  "also write records.jsonl: the complete record of each trial, one per line");
  Option* ro_crate =
      command.AddFlag("--ro-crate", options->with_ro_crate,
                      "also write ro-crate-metadata.json: contents and provenance, for archives");
  ro_crate->Excludes("--out")->Excludes("--mjcf");
  AddReplaceOption(command, options->replace);
  AddJsonOption(command, options->json);
  AddAcceptDamageOption(command, options->on_damage);
  command.SetAction([options] { Export(*options); });
}

}  // namespace graspbench
