#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "core/base/text/text.h"
#include "datasets/analysis/conditions/sensitivity_summary.h"
#include "reports/session_report.h"
#include "workbench/command.h"
#include "workbench/experiments/session_experiment.h"
#include "workbench/result_page.h"
#include "workbench/tables/experiment_tables.h"
#include "workbench/tables/text_table.h"

namespace graspbench {
std::string FormatSensitivityTables(const SensitivitySummary& summary) {
  return FormatTable(ShowChanges(
             summary.changes, {"setting", "was", "hand", "pairs", "objects", "success [%]",
                               "GFT [ms]", "GFT% [%]", "sigma [N]", "other grasp", "left out"})) +
         DescribeChanges(summary.changes);
}

namespace {

struct SensitivityOptions {
  ExperimentRequest request;
  std::vector<std::string> settings;
  bool grasp_per_condition = false;
  bool json = false;
};

void Run(const SensitivityOptions& options) {
  const ExperimentRequest& request = options.request;
  const std::filesystem::path& folder = request.folder;
  const PreparedSession experiment =
      PrepareExperiment(request, "sensitivity", [&options](const SessionConfig& config) {
        const auto conditions = ListSensitivityConditions(config, options.settings);
        return options.grasp_per_condition ? ChooseAgain(conditions, config) : conditions;
      });
  if (!RunOrPlan(experiment, request)) return;
  const Session session = LoadSession(folder, request.on_damage, RecordParts::kBrief);
  const SensitivityData data = LoadSensitivity(session);
  const std::filesystem::path report = WriteSessionReport(folder, session, MakeKeptTracer(session));
  const SensitivitySummary summary = SummariseSensitivity(session, data);
  options.json ? PrintJson(RecordToJson(summary))
               : PrintResult(FormatSensitivityTables(summary) + FormatPlaces(report));
}

}  // namespace

void AddSensitivityCommand(Command& program) {
  Command& command = AddSubcommand(
      program, "sensitivity", "Repeat the trials of a session with one changed setting at a time.",
      "  graspbench sensitivity results/pilot       unmeasured parameters at 0.5 and 2 times\n"
      "  graspbench sensitivity results/pilot --set model.mass_scale=1.1 --trials 3");
  const auto options = std::make_shared<SensitivityOptions>();
  ExperimentRequest& request = options->request;
  AddStoreFolder(command, request.folder, "folder of the session");
  command
      .AddOption(
          "--set", options->settings,
          "setting to vary instead of the default list, with the session's grasps; may be repeated",
          "KEY=VALUE")
      ->OneValueEach();
  command.AddFlag("--grasp-per-condition", options->grasp_per_condition,
                  "choose best grasps under each condition (default: those of the base)");
  AddTrialsOption(command, request.trials_per_cell, "all");
  AddJobsOption(command, request.num_workers);
  AddPlanOnlyOption(command, request.plan_only);
  AddTrialTimeoutOption(command, request.trial_time_limit);
  AddAcceptDamageOption(command, request.on_damage);
  AddJsonOption(command, options->json, "print the summary as one JSON object");
  command.SetAction([options] { Run(*options); });
}

}  // namespace graspbench
