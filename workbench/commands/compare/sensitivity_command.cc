#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "core/base/text/range_text.h"
#include "core/base/text/text.h"
#include "datasets/analysis/conditions/sensitivity_summary.h"
#include "reports/session_report.h"
#include "workbench/commands/command.h"
#include "workbench/experiments/interrupt.h"
#include "workbench/experiments/session_experiment.h"
#include "workbench/tables/experiment_tables.h"
#include "workbench/tables/text_table.h"
#include "workbench/terminal/terminal_observer.h"
#include "workbench/trace_session.h"

namespace graspbench {
std::string FormatSensitivityTables(const SensitivitySummary& summary) {
  std::vector<std::string> heading = {"setting",     "was",      "hand",     "pairs",
                                      "success [%]", "GFT [ms]", "GFT% [%]", "sigma [N]"};
  const bool leaves_out =
      std::any_of(summary.changes.begin(), summary.changes.end(),
                  [](const SettingChange& change) { return change.num_left_out > 0; });
  if (leaves_out) heading.push_back("left out");
  TextTable table(heading);
  for (const SettingChange& change : summary.changes) {
    std::vector<std::string> cells = {
        FormatSetting(change.setting),
        FormatSetting(change.value),
        change.hand,
        CountPairs(change),
        FormatWithRange(100.0 * change.rate_change(), 100.0 * change.rate_change_low,
                        100.0 * change.rate_change_high, 1),
        FormatChange(change, "gft_s", 1e3, 0),
        FormatChange(change, "gft_ratio", 100.0, 1),
        FormatChange(change, "sigma_n", 1.0, 2)};
    if (leaves_out) cells.push_back(change.why_left_out);
    table.AddRow(cells);
  }
  return table.Format() + DescribeChanges(summary.changes);
}

namespace {

struct SensitivityOptions {
  ExperimentRequest request;
  std::vector<std::string> settings;
  int num_workers = 1;
  bool json = false;
};

void Run(const SensitivityOptions& options) {
  const ExperimentRequest& request = options.request;
  const std::filesystem::path& folder = request.folder;
  const PreparedSession experiment =
      PrepareExperiment(request, "sensitivity", [&options](const SessionConfig& config) {
        return ListSensitivityConditions(config, options.settings);
      });
  if (request.plan_only) return PrintExperimentPlan(experiment);
  const std::atomic<bool>& stop = CatchInterrupts();
  TerminalObserver observer(DescribeTasks, stop);
  DemandFinished(RunExperiment(experiment, request, options.num_workers, observer, stop));
  const Session session = LoadSession(folder, request.on_damage, RecordParts::kBrief);
  const SensitivityData data = LoadSensitivity(session);
  const std::filesystem::path report = WriteSessionReport(folder, session, MakeKeptTracer(session));
  const SensitivitySummary summary = SummariseSensitivity(session, data);
  if (options.json) {
    PrintJson(RecordToJson(summary));
  } else {
    PrintResult(FormatSensitivityTables(summary) + "\nreport   " + report.string() + "\n");
  }
}

}  // namespace

void AddSensitivityCommand(Command& program, ExitCode&) {
  Command& command = AddSubcommand(
      program, "sensitivity",
      "Run a session's trials again under one changed setting each and show what that changes.",
      "  graspbench sensitivity results/pilot       unmeasured parameters at 0.5 and 2 times\n"
      "  graspbench sensitivity results/pilot --set model.mass_scale=1.1 --trials 3");
  const auto options = std::make_shared<SensitivityOptions>();
  ExperimentRequest& request = options->request;
  AddStoreFolder(command, request.folder, "folder of the session");
  command
      .AddOption("--set", options->settings,
                 "a setting to try instead of the usual ones, with the session's grasps; may be "
                 "repeated")
      ->OneValueEach()
      ->ValueName("KEY=VALUE");
  command
      .AddOption("--trials", request.trials_per_cell,
                 "finished trials of each hand, object, grasp to take")
      ->Within(1, 100000)
      ->ValueName("N")
      ->ShowDefault("all");
  AddJobsOption(command, options->num_workers);
  AddPlanOnlyOption(command, request.plan_only);
  AddTrialTimeoutOption(command, request.trial_time_limit);
  AddAcceptDamageOption(command, request.on_damage);
  command.AddFlag("--json", options->json, "print the summary as one JSON object");
  command.SetAction([options] { Run(*options); });
}

}  // namespace graspbench
