#include <filesystem>
#include <memory>
#include <string>

#include "core/base/enum_table.h"
#include "core/base/text/text.h"
#include "datasets/analysis/conditions/sweep_summary.h"
#include "datasets/analysis/conditions/threshold_summary.h"
#include "datasets/analysis/export_result.h"
#include "datasets/plan/sweep_design.h"
#include "reports/session_report.h"
#include "workbench/commands/command.h"
#include "workbench/commands/options/session_options.h"
#include "workbench/experiments/interrupt.h"
#include "workbench/experiments/machines/shell_quote.h"
#include "workbench/experiments/run_sweep.h"
#include "workbench/tables/sweep_tables.h"
#include "workbench/terminal/terminal_observer.h"

namespace graspbench {
namespace {
struct SweepOptions {
  SessionOptions session;
  std::vector<std::string> factors;
  std::string design;
  bool judge = false;
  std::string threshold;
  std::string out;
  bool resume = false;
  bool plan_only = false;
  OnDamage on_damage = OnDamage::kRefuse;
  double trial_time_limit = kTrialTimeLimit;
  int num_workers = 1;
  bool json = false;
};

SweepConfig MakeSweepConfig(const SweepOptions& options) {
  SweepConfig config;
  if (!options.session.file().empty()) config = LoadSweepConfig(options.session.file());
  options.session.ApplyTo(config);
  if (!options.factors.empty()) config.factors = options.factors;
  if (!options.design.empty()) config.design = options.design;
  config.judge = config.judge || options.judge;
  if (!options.threshold.empty()) config.threshold = options.threshold;
  return config;
}

ExitCode Finish(const SweepOptions& options, const std::filesystem::path& folder) {
  const Session session = LoadSession(folder, options.on_damage, RecordParts::kBrief);
  ExportResult(folder, session);
  const std::filesystem::path report = WriteSessionReport(folder, session);
  const SweepSummary summary = SummariseSweep(session, LoadThresholds(session));
  if (options.json) {
    Json json = ToJson(summary);
    json["folder"] = folder.string();
    json["report"] = report.string();
    PrintJson(json);
  } else {
    PrintResult(FormatSweepTables(summary) + "\nreport   " + report.string() + "\ndata     " +
                (folder / "export" / "effects.csv").string() + "\n");
  }
  int num_failures = 0;
  for (const ConditionRow& row : summary.rows) num_failures += row.num_numerical;
  return num_failures > 0 ? kExitNumericalFailures : kExitOk;
}
ExitCode Sweep(const SweepOptions& options) {
  SessionRequest request;
  request.name = options.session.file().empty() ? "sweep" : options.session.name();
  request.out = options.out;
  request.resume = options.resume && HasSession(options.out);
  request.on_damage = options.on_damage;
  bool with_judge = options.judge;
  std::string threshold = options.threshold;
  if (!options.resume || !options.factors.empty() || options.session.HasAny()) {
    const SweepConfig config = MakeSweepConfig(options);
    with_judge = config.judge;
    threshold = config.threshold;
    request.config = MakeSweep(config);
  } else if (!request.resume) {
    throw Error(ErrorKind::kUsage, "--resume needs --out DIR, the folder of a sweep");
  }
  const ThresholdScale* const scale =
      threshold.empty() ? nullptr : &RowFromName(kThresholdScales, threshold, "threshold");
  if (scale && request.config) ListThresholdGrips(*scale, *request.config);  // or is refused here
  const PreparedSession sweep = PrepareSession(request);
  PrintMessage(sweep.folder.string() + ": " +
               FormatCount(static_cast<int>(sweep.config.conditions.size()) + 1, "condition") +
               ", " + FormatCount(static_cast<int>(sweep.session.plan.size()), "trial") + ", " +
               std::to_string(FindUnfinished(sweep.session).size()) + " to run");
  if (options.plan_only) {
    RecordPlanning(sweep.folder);
    PrintMessage("about " + FormatFixed(EstimateSweepTime(sweep, with_judge, scale != nullptr), 0) +
                 " s of one processor, judged by the first trial of each hand");
    PrintExperimentPlan(sweep);
    if (scale) {
      PrintMessage("then     graspbench threshold " + QuoteForShell(sweep.folder.string()) +
                   " --by " + scale->name + " --plan-only");
    }
    return kExitOk;
  }
  const std::atomic<bool>& stop = CatchInterrupts();
  TerminalObserver observer({}, stop);
  ExperimentRequest rest;
  rest.with_judge = with_judge;
  rest.on_damage = options.on_damage;
  rest.trial_time_limit = options.trial_time_limit;
  DemandFinished(RunSweep(sweep, scale, rest, options.num_workers, observer, stop));
  return Finish(options, sweep.folder);
}
}  // namespace

void AddSweepCommand(Command& program, ExitCode& exit_code) {
  Command& command = AddSubcommand(
      program, "sweep", "Run a session under every combination of some settings and compare them.",
      "  graspbench sweep --object can,cup --factor model.mass_scale=1,2 --factor grasp=g1,g2\n"
      "  graspbench sweep sweep.yaml --design one-at-a-time --plan-only --out results/sweep");
  const auto options = std::make_shared<SweepOptions>();
  options->session.AddTo(command, "sweep.yaml (graspbench new sweep)");
  command
      .AddOption("--factor", options->factors,
                 "a setting, grasp, delay.last, delay.first [s] or backend with its levels, the "
                 "base's first; best is chosen at the base's levels; may be repeated")
      ->OneValueEach()
      ->ValueName("KEY=A,B,..");
  command
      .AddOption("--design", options->design,
                 "full, one-at-a-time, or latin:N: base and at most N of a Latin hypercube")
      ->ValueName("DESIGN")
      ->ShowDefault("full");
  command.AddFlag("--judge", options->judge, "also break what is held; some five times as long");
  command
      .AddOption("--threshold", options->threshold,
                 "also find the smallest margin, or force, with which each draw succeeds, under "
                 "every condition; at most six more trials each")
      ->OneOf(ListNames(kThresholdScales))
      ->ValueName("SCALE");
  AddJobsOption(command, options->num_workers);
  command.AddOption("--out", options->out, "folder of the sweep")
      ->ValueName("DIR")
      ->ShowDefault("results/sweep-HASH");
  command.AddFlag("--resume", options->resume, "continue the sweep in the folder of --out");
  AddPlanOnlyOption(command, options->plan_only);
  AddAcceptDamageOption(command, options->on_damage);
  AddTrialTimeoutOption(command, options->trial_time_limit);
  command.AddFlag("--json", options->json, "print the summary as one JSON object");
  command.SetAction([options, &exit_code] { exit_code = Sweep(*options); });
}
}  // namespace graspbench
