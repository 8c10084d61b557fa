#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>

#include "core/base/enum_table.h"
#include "core/base/text/range_text.h"
#include "core/base/text/text.h"
#include "datasets/analysis/conditions/threshold_summary.h"
#include "datasets/analysis/export_result.h"
#include "reports/session_report.h"
#include "workbench/commands/command.h"
#include "workbench/experiments/interrupt.h"
#include "workbench/experiments/session_experiment.h"
#include "workbench/tables/experiment_tables.h"
#include "workbench/tables/text_table.h"
#include "workbench/terminal/terminal_observer.h"
#include "workbench/trace_session.h"

namespace graspbench {
std::string FormatThresholdTables(const ThresholdSummary& summary) {
  const ThresholdScale& scale = *summary.scale;
  const bool is_sweep =
      std::any_of(summary.cells.begin(), summary.cells.end(),
                  [](const CellThreshold& cell) { return !cell.condition.empty(); });
  std::vector<std::string> heading = {"hand",       "object",         "grasp",
                                      "draws",      "grip threshold", "95 % interval",
                                      "never held", "not monotone"};
  if (is_sweep) heading.insert(heading.begin(), "condition");
  TextTable table(heading);
  int num_draws = 0;
  for (const CellThreshold& cell : summary.cells) {
    num_draws += cell.num_draws;
    std::vector<std::string> cells = {
        cell.hand,
        cell.object,
        cell.grasp,
        std::to_string(cell.num_draws),
        FormatMedian(scale, cell),
        std::isnan(cell.low)
            ? "n/a"
            : FormatThreshold(scale, cell.low) + " to " + FormatThreshold(scale, cell.high),
        std::to_string(cell.num_never),
        NameNotMonotone(cell)};
    if (is_sweep) cells.insert(cells.begin(), cell.condition.empty() ? "base" : cell.condition);
    table.AddRow(cells);
  }
  const std::string ceilings = DescribeCeilings(summary);
  return table.Format() + "smallest " + scale.name +
         " with which a draw succeeds, median of the draws; " + FormatCount(num_draws, "draw") +
         ", " + FormatCount(summary.num_trials, "trial") + ", " +
         std::to_string(summary.num_not_monotone()) + " not monotone as far as was asked\n" +
         (ceilings.empty() ? "" : ceilings + "\n");
}

namespace {

struct ThresholdOptions {
  ExperimentRequest request;
  std::string scale = kThresholdScales[0].name;
  int num_workers = 1;
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
  if (request.plan_only) return PrintExperimentPlan(experiment);
  const std::atomic<bool>& stop = CatchInterrupts();
  TerminalObserver observer(DescribeTasks, stop);
  DemandFinished(RunExperiment(experiment, request, options.num_workers, observer, stop));
  const Session session = LoadSession(folder, request.on_damage, RecordParts::kBrief);
  const ThresholdSummary summary = SummariseThresholds(
      LoadSession(experiment.folder, request.on_damage, RecordParts::kBrief), session);
  ExportResult(folder, session);
  const std::filesystem::path report = WriteSessionReport(folder, session, MakeKeptTracer(session));
  if (options.json) return PrintJson(ToJson(summary));
  PrintResult(FormatThresholdTables(summary) + "\nreport   " + report.string() + "\ndata     " +
              (folder / "export" / "thresholds.csv").string() + "\n");
}

}  // namespace

void AddThresholdCommand(Command& program, ExitCode&) {
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
                 "what is bisected: margin (1 to 16), force (0.1 to 12.8 N)")
      ->OneOf(ListNames(kThresholdScales))
      ->ValueName("SCALE")
      ->ShowDefault();
  command
      .AddOption("--trials", request.trials_per_cell,
                 "finished trials of each hand, object, grasp to take")
      ->Within(1, 100000)
      ->ValueName("N")
      ->ShowDefault("all");
  AddPlanOnlyOption(command, request.plan_only);
  AddJobsOption(command, options->num_workers);
  AddTrialTimeoutOption(command, request.trial_time_limit);
  AddAcceptDamageOption(command, request.on_damage);
  command.AddFlag("--json", options->json, "print the thresholds as one JSON object");
  command.SetAction([options] { Run(*options); });
}

}  // namespace graspbench
