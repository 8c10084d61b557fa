#include <memory>
#include <string>

#include "core/base/text/text.h"
#include "datasets/analysis/export_result.h"
#include "datasets/analysis/map/map_result.h"
#include "datasets/plan/scene_names.h"
#include "reports/session_report.h"
#include "workbench/commands/command.h"
#include "workbench/commands/options/session_options.h"
#include "workbench/experiments/interrupt.h"
#include "workbench/experiments/run_map.h"
#include "workbench/tables/map_tables.h"
#include "workbench/terminal/terminal_observer.h"

namespace graspbench {
namespace {

struct MapOptions {
  SessionConfig base;
  MapRequest request;
  std::string out;
  int num_workers = 1;
  bool json = false;
};

ExitCode Run(MapOptions& options) {
  options.request.base = options.base;
  options.request.base.objects = ExpandObjects(options.base.objects);
  options.request.out = options.out;
  const PreparedSession success = PrepareMap(options.request);
  PrintMessage(success.folder.string() + ": " +
               FormatCount(static_cast<int>(success.config.conditions.size()) + 1, "condition") +
               ", " + FormatCount(static_cast<int>(success.session.plan.size()), "trial") +
               " of success, " + std::to_string(FindUnfinished(success.session).size()) +
               " to run" + (options.request.is_quick ? "" : "; then thresholds and strength"));
  const std::atomic<bool>& stop = CatchInterrupts();
  TerminalObserver observer({}, stop);
  DemandFinished(RunMap(success, options.request, options.num_workers, observer, stop));
  const Session session =
      LoadSession(success.folder, options.request.on_damage, RecordParts::kBrief);
  ExportResult(success.folder, session);
  const std::filesystem::path report = WriteSessionReport(success.folder, session);
  const MapResult result = LoadMap(session);
  if (options.json) {
    Json json = ToJson(result);
    json["folder"] = success.folder.string();
    json["report"] = report.string();
    PrintJson(json);
  } else {
    PrintResult(FormatMap(result) + "\nreport   " + report.string() + "\ndata     " +
                (success.folder / "export" / "map.csv").string() + "\n");
  }
  return kExitOk;
}

}  // namespace

void AddMapCommand(Command& program, ExitCode& exit_code) {
  Command& group = AddSubcommand(program, "map", "Map where something matters.",
                                 "  graspbench map simultaneity --quick --out results/quick");
  group.RequireSubcommand();
  Command& command = AddSubcommand(
      group, "simultaneity",
      "Map where it matters that the digits touch at once: one digit is made late on the same "
      "draws.",
      "  graspbench map simultaneity --quick --out results/quick    success, some six minutes\n"
      "  graspbench map simultaneity --out results/map              all of it, about an hour of "
      "one processor\n"
      "The same command again continues it.");
  const auto options = std::make_shared<MapOptions>();
  AddSceneOptions(command, options->base);
  command.AddOption("--seed", options->base.seed, "another seed gives other draws")
      ->ShowDefault()
      ->ValueName("N");
  command.AddFlag("--quick", options->request.is_quick,
                  "success alone, one delay and one draw of each object and region");
  AddJobsOption(command, options->num_workers);
  command.AddOption("--out", options->out, "folder of the map")
      ->ValueName("DIR")
      ->ShowDefault("results/map-HASH");
  AddAcceptDamageOption(command, options->request.on_damage);
  AddTrialTimeoutOption(command, options->request.trial_time_limit);
  AddJsonOption(command, options->json);
  command.SetAction([options, &exit_code] { exit_code = Run(*options); });
}

}  // namespace graspbench
