#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "core/base/text/text.h"
#include "datasets/analysis/conditions/sensitivity_summary.h"
#include "reports/session_report.h"
#include "workbench/commands/command.h"
#include "workbench/experiments/interrupt.h"
#include "workbench/experiments/run_sensitivity.h"
#include "workbench/tables/sensitivity_tables.h"
#include "workbench/terminal/terminal_observer.h"
#include "workbench/trace_session.h"

namespace graspbench {
namespace {

struct SensitivityOptions {
  SensitivityRequest request;
  int num_workers = 1;
  bool json = false;
};

void Run(const SensitivityOptions& options) {
  const SensitivityRequest& request = options.request;
  const std::filesystem::path& folder = request.folder;
  const PreparedSession experiment = PrepareSensitivity(request);
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
  SensitivityRequest& request = options->request;
  AddStoreFolder(command, request.folder, "folder of the session");
  command
      .AddOption("--set", request.settings,
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
