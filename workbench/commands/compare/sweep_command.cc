#include <filesystem>
#include <memory>
#include <string>

#include "core/base/enum_table.h"
#include "core/base/text/text.h"
#include "datasets/analysis/conditions/sweep_summary.h"
#include "datasets/analysis/conditions/threshold_summary.h"
#include "datasets/plan/conditions.h"
#include "workbench/command.h"
#include "workbench/commands/options/session_options.h"
#include "workbench/experiments/machines/shell_quote.h"
#include "workbench/experiments/session_experiment.h"
#include "workbench/result_page.h"
#include "workbench/tables/experiment_tables.h"
#include "workbench/terminal/terminal_observer.h"

namespace graspbench {
namespace {
struct SweepOptions {
  SessionOptions session;
  std::vector<std::string> factors;
  std::string design;
  bool judge = false;
  std::string threshold;
  bool grasp_per_condition = false;
  RunOptions run;
};

SweepConfig MakeSweepConfig(const SweepOptions& options) {
  SweepConfig config;
  if (!options.session.file().empty()) config = LoadSweepConfig(options.session.file());
  options.session.ApplyTo(config);
  if (!options.factors.empty()) config.factors = options.factors;
  if (!options.design.empty()) config.design = options.design;
  config.judge = config.judge || options.judge;
  if (!options.threshold.empty()) config.threshold = options.threshold;
  config.grasp_per_condition = config.grasp_per_condition || options.grasp_per_condition;
  return config;
}

ExitCode Finish(const SweepOptions& options, const std::filesystem::path& folder) {
  const Session session = LoadSession(folder, options.run.on_damage, RecordParts::kBrief);
  const std::filesystem::path report = WriteResults(session);
  const SweepSummary summary = SummariseSweep(session, LoadThresholds(session));
  if (options.run.json) {
    Json json = ToJson(summary);
    json["folder"] = folder.string();
    json["report"] = report.string();
    PrintJson(json);
  } else {
    PrintResult(FormatSweepTables(summary) +
                FormatPlaces(report, folder / "export" / "effects.csv"));
  }
  int num_failures = 0;
  for (const ConditionRow& row : summary.rows) num_failures += row.num_numerical;
  return num_failures > 0 ? kExitNumericalFailures : kExitOk;
}
ExitCode Sweep(const SweepOptions& options) {
  SessionRequest request;
  request.name = options.session.file().empty() ? "sweep" : options.session.name();
  request.out = options.run.out;
  request.resume = options.run.resume && HasSession(options.run.out);
  request.on_damage = options.run.on_damage;
  bool with_judge = options.judge;
  std::string threshold = options.threshold;
  if (!options.run.resume || !options.factors.empty() || options.session.HasAny()) {
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
  if (request.config) RehearseGrasps(*request.config, options.run.num_workers);
  const PreparedSession sweep = PrepareSession(request);
  PrintMessage(sweep.folder.string() + ": " +
               FormatCount(static_cast<int>(sweep.config.conditions.size()) + 1, "condition") +
               ", " + FormatCount(static_cast<int>(sweep.session.plan.size()), "trial") + ", " +
               std::to_string(FindUnfinished(sweep.session).size()) + " to run");
  if (options.run.plan_only) {
    RecordPlanning(sweep.folder);
    PrintMessage("about " + FormatFixed(EstimateSweepTime(sweep, with_judge, scale != nullptr), 0) +
                 " s of one processor, estimated from the first trial of each hand");
    PrintExperimentPlan(sweep);
    if (scale) {
      PrintMessage("then     graspbench threshold " + QuoteForShell(sweep.folder.string()) +
                   " --by " + scale->name + " --plan-only");
    }
    return kExitOk;
  }
  TerminalObserver observer;
  ExperimentRequest rest;
  rest.with_judge = with_judge;
  rest.on_damage = options.run.on_damage;
  rest.trial_time_limit = options.run.trial_time_limit;
  rest.thresholds = scale;
  rest.num_workers = options.run.num_workers;
  DemandFinished(RunExperiment(sweep, rest, observer));
  return Finish(options, sweep.folder);
}
}  // namespace

void AddSweepCommand(Command& program) {
  Command& command = AddSubcommand(
      program, "sweep",
      "Run a session under every combination of several settings and compare them.",
      "  graspbench sweep --object can,cup --factor model.mass_scale=1,2 --factor grasp=g1,g2\n"
      "  graspbench sweep sweep.yaml --design one-at-a-time --plan-only --out results/sweep");
  const auto options = std::make_shared<SweepOptions>();
  options->session.AddTo(command, "sweep.yaml (graspbench new sweep)");
  command
      .AddOption("--factor", options->factors,
                 "factor (a setting, grasp, delay.last, delay.first [s] or backend) and its "
                 "levels, base level first; best is chosen at the base levels; may be repeated",
                 "KEY=A,B,..")
      ->OneValueEach();
  command
      .AddOption(
          "--design", options->design,
          "full, one-at-a-time, or latin:N (the base and at most N points of a Latin hypercube)",
          "DESIGN")
      ->ShowDefault("full");
  command.AddFlag("--judge", options->judge,
                  "also find breaking forces; takes about five times as long");
  command
      .AddOption("--threshold", options->threshold,
                 "also find the smallest margin or force with which each draw succeeds under every "
                 "condition, in at most six more trials",
                 "SCALE")
      ->OneOf(ListNames(kThresholdScales));
  command.AddFlag("--grasp-per-condition", options->grasp_per_condition,
                  "choose best grasps again under each condition; else the base's are taken");
  AddRunOptions(command, options->run, "sweep", "results/sweep-HASH");
  command.SetAction([options] { return Sweep(*options); });
}
}  // namespace graspbench
