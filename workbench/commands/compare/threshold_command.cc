#include <filesystem>
#include <memory>

#include "core/base/enum_table.h"
#include "core/base/text/text.h"
#include "datasets/analysis/conditions/threshold_summary.h"
#include "workbench/command.h"
#include "workbench/experiments/session_experiment.h"
#include "workbench/result_page.h"
#include "workbench/tables/experiment_tables.h"
#include "workbench/tables/text_table.h"

namespace graspbench {
std::string FormatThresholdTables(const ThresholdSummary& summary) {
  int num_draws = 0;
  for (const CellThreshold& cell : summary.cells) num_draws += cell.num_draws;
  const std::string ceilings = DescribeCeilings(summary);
  return FormatTable(ShowCells(summary)) + "smallest " + summary.scale->name +
         " with which a draw succeeds, median over draws; " + FormatCount(num_draws, "draw") +
         ", " + FormatCount(summary.num_trials, "trial") + ", " +
         std::to_string(summary.num_not_monotone()) + " not monotone within the tested range\n" +
         (ceilings.empty() ? "" : ceilings + "\n");
}

namespace {

struct ThresholdOptions {
  ExperimentRequest request;
  std::string scale = kThresholdScales[0].name;
  bool json = false;
};

void Run(const ThresholdOptions& options) {
  const ExperimentRequest& request = options.request;
  const std::filesystem::path& folder = request.folder;
  const ThresholdScale& scale = RowFromName(kThresholdScales, options.scale, "scale");
  const PreparedSession experiment = PrepareThresholds(request, scale);
  for (const std::string& warning :
       ListThresholdWarnings(scale, experiment.config, experiment.inputs)) {
    PrintMessage("warning: " + warning);
  }
  if (!RunOrPlan(experiment, request)) return;
  const Session session = LoadSession(folder, request.on_damage, RecordParts::kBrief);
  const ThresholdSummary summary = SummariseThresholds(
      LoadSession(experiment.folder, request.on_damage, RecordParts::kBrief), session);
  const std::filesystem::path report = WriteResults(session, MakeKeptTracer(session));
  if (options.json) return PrintJson(ToJson(summary));
  PrintResult(FormatThresholdTables(summary) +
              FormatPlaces(report, folder / "export" / "thresholds.csv"));
}

}  // namespace

void AddThresholdCommand(Command& program) {
  Command& command = AddSubcommand(
      program, "threshold", "Find the smallest grip with which each draw of a session succeeds.",
      "  graspbench threshold results/pilot             margins of 1 to 16, by bisection\n"
      "  graspbench threshold results/pilot --by force --trials 3\n"
      "  graspbench threshold results/sweep             under each condition of a sweep");
  const auto options = std::make_shared<ThresholdOptions>();
  ExperimentRequest& request = options->request;
  AddStoreFolder(command, request.folder, "folder of the session");
  command
      .AddOption("--by", options->scale,
                 "quantity to bisect: margin (1 to 16) or force (0.1 to 12.8 N)", "SCALE")
      ->OneOf(ListNames(kThresholdScales))
      ->ShowDefault();
  AddTrialsOption(command, request.trials_per_cell, "all");
  AddPlanOnlyOption(command, request.plan_only);
  AddJobsOption(command, request.num_workers);
  AddTrialTimeoutOption(command, request.trial_time_limit);
  AddAcceptDamageOption(command, request.on_damage);
  AddJsonOption(command, options->json, "print the thresholds as one JSON object");
  command.SetAction([options] { Run(*options); });
}

}  // namespace graspbench
