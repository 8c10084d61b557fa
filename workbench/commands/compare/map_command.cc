#include <memory>
#include <string>

#include "core/base/text/text.h"
#include "datasets/analysis/map/map_result.h"
#include "datasets/plan/rehearsed_grasps.h"
#include "datasets/plan/scene_names.h"
#include "workbench/command.h"
#include "workbench/commands/options/session_options.h"
#include "workbench/experiments/session_experiment.h"
#include "workbench/result_page.h"
#include "workbench/tables/experiment_tables.h"
#include "workbench/terminal/terminal_observer.h"

namespace graspbench {
namespace {

struct MapOptions {
  SessionConfig base;
  MapRequest request;
  std::string out;
  bool json = false;
};

void Run(MapOptions& options) {
  options.request.base = options.base;
  options.request.base.objects = ExpandObjects(options.base.objects);
  options.request.base.grasps = JoinRehearsed(options.base.grasps);
  options.request.out = options.out;
  RehearseGrasps(options.request.base, options.request.num_workers);
  const PreparedSession success = PrepareMap(options.request);
  PrintMessage(success.folder.string() + ": " +
               FormatCount(static_cast<int>(success.config.conditions.size()) + 1, "condition") +
               ", " + FormatCount(static_cast<int>(success.session.plan.size()), "trial") +
               " of success, " + std::to_string(FindUnfinished(success.session).size()) +
               " to run" + (options.request.is_quick ? "" : "; then thresholds and strength"));
  TerminalObserver observer;
  DemandFinished(RunMap(success, options.request, observer));
  const Session session =
      LoadSession(success.folder, options.request.on_damage, RecordParts::kBrief);
  const std::filesystem::path report = WriteResults(session);
  const MapResult result = LoadMap(session);
  if (options.json) {
    Json json = ToJson(result);
    json["folder"] = success.folder.string();
    json["report"] = report.string();
    PrintJson(json);
  } else {
    PrintResult(FormatMap(result) + FormatPlaces(report, success.folder / "export" / "map.csv"));
  }
}

}  // namespace

void AddMapCommand(Command& program) {
  Command& group =
      AddSubcommand(program, "map", "Map the settings under which a factor has an effect.",
                    "  graspbench map simultaneity --quick --out results/quick");
  group.RequireSubcommand();
  Command& command =
      AddSubcommand(group, "simultaneity",
                    "Map the settings under which simultaneous contact affects success, by "
                    "delaying one digit on the same draws.",
                    "  graspbench map simultaneity --quick --out results/quick    success, about "
                    "six minutes\n  graspbench map simultaneity --out results/map              all "
                    "measures, about an hour of one processor\nRepeat the command to continue.");
  const auto options = std::make_shared<MapOptions>();
  AddSceneOptions(command, options->base);
  AddListOption(command, "--grasp", options->base.grasps, "best, rehearsed or ids", "G,..");
  AddSeedOption(command, options->base.seed, "other draws");
  command.AddFlag("--quick", options->request.is_quick,
                  "success only, one delay, one draw per object and region");
  AddJobsOption(command, options->request.num_workers);
  command.AddOption("--out", options->out, "folder for the map", "DIR")
      ->ShowDefault("results/map-HASH");
  AddAcceptDamageOption(command, options->request.on_damage);
  AddTrialTimeoutOption(command, options->request.trial_time_limit);
  AddJsonOption(command, options->json);
  command.SetAction([options] { Run(*options); });
}

}  // namespace graspbench
