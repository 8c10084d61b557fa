#include <CLI/CLI.hpp>
#include <cstdio>
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

struct PictureSize {
  int width = 0, height = 0;
};
PictureSize ParseSize(const std::string& text) {
  constexpr int kMaxSide = 4096;
  PictureSize size;
  int end = 0;
  const bool is_one =
      std::sscanf(text.c_str(), "%4dx%4d%n", &size.width, &size.height, &end) == 2 &&
      static_cast<size_t>(end) == text.size();
  if (is_one && size.width > 0 && size.height > 0 && size.width <= kMaxSide &&
      size.height <= kMaxSide) {
    return size;
  }
  throw Error(ErrorKind::kUsage, "--size: \"" + text + "\"; expected WIDTHxHEIGHT of 1 to " +
                                     std::to_string(kMaxSide) + " pixels, as 960x720");
}

std::string FindDefaultInstant(const TracedTrial& traced) {
  for (const TraceInstant& instant : traced.trace) {
    if (instant.phase == Phase::kLiftOff) return NameOf(Phase::kStabilisation);
  }
  return NameOf(traced.trace.empty() ? Phase::kPlacing : traced.trace.back().phase);
}

std::string DrawPicture(const TrialOptions& options, const ExaminedTrial& trial) {
  const PictureSize size = ParseSize(options.size);
  const TraceInstant& instant = FindNamedInstant(
      trial.traced, options.at.empty() ? FindDefaultInstant(trial.traced) : options.at);
  return EncodePng(DrawTrial(trial, instant, ParseSceneView(options.view, "trial --help"),
                             size.width, size.height));
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
  ParseSize(options.size);
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
  command
      .add_option("--at", options->at,
                  "which instant: a time as 1.25s, or the end of a phase; else stabilisation's")
      ->needs(render)
      ->option_text("TIME|PHASE");
  command.add_option("--camera", options->view, "from where: " + ListNames(ListSceneViews()))
      ->needs(render)
      ->expected(1, 4)
      ->option_text("VIEW [AZ EL [ZOOM]]");
  command.add_option("--size", options->size, "of the picture, in pixels")
      ->needs(render)
      ->option_text("WxH")
      ->capture_default_str();
  AddAcceptDamageOption(command, options->on_damage);
  command.add_flag("--json", options->json, "print one JSON object");
  command.callback([options, &exit_code] { exit_code = ShowTrial(*options); });
}

}  // namespace graspbench
