#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <string>

#include "core/base/text/text.h"
#include "core/base/units.h"
#include "datasets/analysis/conditions/basin_summary.h"
#include "datasets/analysis/export_result.h"
#include "reports/session_report.h"
#include "workbench/commands/command.h"
#include "workbench/experiments/interrupt.h"
#include "workbench/experiments/map_basin.h"
#include "workbench/experiments/session_experiment.h"
#include "workbench/terminal/terminal_observer.h"

namespace graspbench {
namespace {

struct BasinOptions {
  BasinRequest request;
  bool plan_only = false, json = false;
  double trial_time_limit = kTrialTimeLimit;
  int num_workers = 1;
};

void Run(const BasinOptions& options) {
  const PreparedSession basin = PrepareBasin(options.request);
  if (options.plan_only) {
    RecordPlanning(basin.folder);
    return PrintExperimentPlan(basin, options.json);
  }
  const std::atomic<bool>& stop = CatchInterrupts();
  TerminalObserver observer({}, stop);
  ExperimentRequest request;
  request.trial_time_limit = options.trial_time_limit;
  DemandFinished(RunExperiment(basin, request, options.num_workers, observer, stop));
  const Session session = LoadSession(basin.folder, OnDamage::kRefuse, RecordParts::kBrief);
  ExportResult(basin.folder, session);
  const std::filesystem::path report = WriteSessionReport(basin.folder, session);
  const BasinSummary summary = SummariseBasin(ListBasinSamples(session));
  if (options.json) {
    return PrintJson({{"folder", basin.folder.string()},
                      {"report", report.string()},
                      {"samples", summary.num_samples},
                      {"successes", summary.num_successes},
                      {"radius", summary.radius},
                      {"radius_offset_mm", MmFromM(summary.radius_offset)},
                      {"radius_yaw_deg", DegFromRad(summary.radius_yaw)}});
  }
  PrintResult(NameBasin(basin.inputs, session.plan.front()) + ": basin radius " +
              FormatFixed(summary.radius, 2) + " (" +
              FormatFixed(MmFromM(summary.radius_offset), 1) + " mm, " +
              FormatFixed(DegFromRad(summary.radius_yaw), 1) + " deg)\nreport   " +
              report.string() + "\n");
}

}  // namespace

void AddBasinCommand(CLI::App& program, ExitCode&) {
  CLI::App& command = AddSubcommand(
      program, "basin", "Map the placement error that a grasp tolerates.",
      "  graspbench basin --hand tum --object golf_ball --out ball_basin\n"
      "  graspbench basin --hand shadow --object can --grasp g3 --samples 400 --out can_basin");
  const auto options = std::make_shared<BasinOptions>();
  BasinRequest& request = options->request;
  command.add_option("--hand", request.hand, "hand by id or folder")
      ->required()
      ->option_text("HAND");
  command.add_option("--object", request.object, "object by id or folder")
      ->required()
      ->option_text("OBJECT");
  command.add_option("--grasp", request.grasp, "best, an id or a grasp file")
      ->option_text("GRASP")
      ->capture_default_str();
  command.add_option("--samples", request.num_samples, "offsets to try")
      ->check(CLI::Range(1, 100000))
      ->option_text("N")
      ->capture_default_str();
  AddJobsOption(command, options->num_workers);
  AddTrialTimeoutOption(command, options->trial_time_limit);
  AddPlanOnlyOption(command, options->plan_only);
  command.add_option("--out", request.out, "folder for report and basin.csv")
      ->required()
      ->option_text("DIR");
  AddReplaceOption(command, request.replace);
  AddJsonOption(command, options->json);
  command.callback([options] { Run(*options); });
}

}  // namespace graspbench
