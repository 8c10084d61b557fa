#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "core/base/files.h"
#include "datasets/session/trace_table.h"
#include "workbench/commands/command.h"
#include "workbench/experiments/output_folder.h"
#include "workbench/trial_picture.h"
#include "workbench/trial_text.h"

namespace graspbench {
namespace {

constexpr double kCoarse = 0.01;  // interval of instants where nobody asks for every step [s]

struct TrialOptions {
  std::filesystem::path folder;
  std::string name;
  std::string trace;
  std::string picture;
  std::string at;  // empty: when it was closed, or the end of a shorter trial
  std::vector<std::string> view;
  std::string size = "960x720";
  OnDamage on_damage = OnDamage::kRefuse;
  bool json = false;
};

void CheckEnding(const std::string& option, const std::string& file, const char* ending) {
  if (std::filesystem::path(file).extension() == ending) return;
  throw Error(ErrorKind::kUsage,
              option + ": \"" + file + "\" does not end in " + ending + ", the only form there is");
}

std::string DrawPicture(const TrialOptions& options, const ExaminedTrial& trial) {
  return EncodePng(DrawTrial(trial.setup, trial.traced, FindNamedInstant(trial.traced, options.at),
                             ParseSceneView(options.view, "trial --help"),
                             ParsePictureSize(options.size)));
}

/** Before anything is simulated. */
void CheckOptions(const TrialOptions& options) {
  if (!options.trace.empty()) {
    CheckEnding("--trace", options.trace, ".csv");
    CheckOutputFile(options.trace);
  }
  if (!options.picture.empty()) {
    CheckEnding("--render", options.picture, ".png");
    CheckOutputFile(options.picture);
  }
  ParsePictureSize(options.size);
  ParseSceneView(options.view, "trial --help");
}

ExitCode ShowTrial(const TrialOptions& options) {
  CheckOptions(options);
  const Session session = LoadSession(options.folder, options.on_damage, RecordParts::kBrief);
  const PlannedTrial& planned = FindPlannedTrial(session, options.name);
  const ExaminedTrial trial = ExamineTrial(session, planned, options.trace.empty() ? kCoarse : 0.0);
  const std::string folder = options.folder.string();
  options.json ? PrintJson(MakeTrialJson(trial, folder)) : PrintResult(FormatTrial(trial, folder));
  if (!options.trace.empty()) {
    WriteFileAtomically(options.trace,
                        FormatCsv(ListTraceColumns(*trial.setup.hand), trial.traced.trace));
    PrintMessage(options.trace);
  }
  if (!options.picture.empty()) {
    WriteFileAtomically(options.picture, DrawPicture(options, trial));
    PrintMessage(options.picture);
  }
  return trial.difference ? kExitBadInput : kExitOk;
}

}  // namespace

void AddTrialCommand(CLI::App& program, ExitCode& exit_code) {
  CLI::App& command = AddSubcommand(
      program, "trial", "Run one trial of a session again and tell what happened in it.",
      "  graspbench trial results/pilot tum-can-g2:3\n"
      "  graspbench trial results/pilot 3f2a --render trial.png --at 1.25s --camera free -60 20 "
      "1.5\n"
      "  graspbench trial results/pilot 3f2a --trace trial.csv\n"
      "  graspbench trial results/pilot 3f2a --json");
  const auto options = std::make_shared<TrialOptions>();
  AddStoreFolder(command, options->folder, "the session");
  command
      .add_option("trial", options->name,
                  "its trial_id, the first letters of it, or hand-object-grasp:number")
      ->required()
      ->option_text("ID|CELL:N");
  command.add_option("--trace", options->trace, "write every step as a table (CSV)")
      ->option_text("FILE.CSV");
  CLI::Option* render =
      command.add_option("--render", options->picture, "draw an instant with its forces (PNG)")
          ->option_text("FILE.PNG");
  for (CLI::Option* of_picture :
       AddPictureOptions(command, options->at, options->view, options->size)) {
    of_picture->needs(render);
  }
  AddAcceptDamageOption(command, options->on_damage);
  command.add_flag("--json", options->json, "print one JSON object");
  command.callback([options, &exit_code] { exit_code = ShowTrial(*options); });
}

}  // namespace graspbench
