#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "core/base/config.h"
#include "core/base/hash.h"
#include "core/base/text/text.h"
#include "datasets/analysis/campaign/campaign_summary.h"
#include "datasets/plan/scene_names.h"
#include "reports/campaign/campaign_report.h"
#include "workbench/command.h"
#include "workbench/experiments/machines/shell_quote.h"
#include "workbench/experiments/run_campaign.h"
#include "workbench/experiments/run_record.h"
#include "workbench/tables/optimise_tables.h"
#include "workbench/terminal/terminal_observer.h"

namespace graspbench {
namespace fs = std::filesystem;

namespace {

/** What --compare takes without a value: for each hand a large, a small and a difficult thing. */
const std::vector<std::string> kComparedScenes = {"tum/adhesive_tape",    "tum/toy_propeller",
                                                  "tum/golf_ball",        "shadow/adhesive_tape",
                                                  "shadow/toy_propeller", "shadow/golf_ball"};

struct CampaignOptions {
  CampaignConfig config;
  std::vector<std::string> settings;
  bool compare = false, resume = false, plan_only = false, json = false;
  int num_workers = 1;
  double trial_time_limit = kTrialTimeLimit;
  fs::path real;  ///< a laboratory's trials; empty: none given
  std::string out;
};

std::string DescribeStage(const Stage& stage) {
  const int num_before = stage.num_all - stage.num_left;
  return std::string(RowOf(kStages, stage.kind).name) + ": " + DescribeTasks(stage) +
         (num_before > 0 ? ", " + std::to_string(num_before) + " finished before" : "");
}

fs::path FindFolder(const CampaignOptions& options) {
  if (!options.out.empty()) return options.out;
  const std::string hash = CalcHashHex(FormatJson(ConfigToJson(options.config))).substr(0, 8);
  return fs::path("results") / ("campaign-" + hash);
}

CampaignConfig MakeConfig(CampaignOptions& options) {
  options.config.session.objects = ExpandObjects(options.config.session.objects);
  for (const std::string& setting : options.settings) SetConfigValue(setting, options.config);
  if (options.compare && options.config.comparison.scenes.empty()) {
    options.config.comparison.scenes = kComparedScenes;
  }
  CheckCampaignConfig(options.config);
  return options.config;
}

ExitCode Run(CampaignOptions options) {
  CampaignRequest request;
  if (!options.resume) request.config = MakeConfig(options);
  const fs::path folder = request.folder = FindFolder(options);
  request.num_workers = options.num_workers;
  request.trial_time_limit = options.trial_time_limit;
  request.real = options.real;
  if (request.config) RehearseGrasps(request.config->session, options.num_workers);
  if (options.plan_only) {
    const int num_scenes = PlanCampaign(request);
    RecordPlanning(folder);
    PrintPlan(folder, num_scenes, "scene", options.json);
    return kExitOk;
  }
  PrintMessage(folder.string() + " on " + FormatCount(options.num_workers, "worker"));
  TerminalObserver observer(DescribeStage);
  if (!RunCampaign(request, observer)) {
    throw Error(ErrorKind::kInterrupted,
                "stopped; finished trials are kept. Continue with\n  graspbench campaign --resume "
                "--out " +
                    QuoteForShell(folder.string()));
  }
  const Campaign campaign = LoadCampaign(folder);
  if (!options.real.empty()) {
    const auto num_own = std::count_if(campaign.real.begin(), campaign.real.end(),
                                       [](const RealTrial& trial) { return !trial.is_published; });
    PrintMessage(FormatCount(num_own, "trial") +
                 " with real hands kept; rows without a success value count as trials to do");
  }
  ExportCampaign(folder, campaign);
  const fs::path report = WriteCampaignReport(folder, campaign);
  options.json ? PrintJson(MakeCampaignJson(campaign, folder, report))
               : PrintResult(FormatCampaign(campaign, folder, report));
  const std::string failures = DescribeNumericalFailures(campaign);
  if (failures.empty()) return kExitOk;
  PrintMessage(failures);
  return kExitNumericalFailures;
}

}  // namespace

void AddCampaignCommand(Command& program) {
  Command& command = AddSubcommand(
      program, "campaign",
      "Optimise the grasp of every hand and object, then compare all variants on the same draws.",
      "  graspbench campaign --out results/campaign\n  graspbench campaign --evaluations 1000 "
      "--compare --out results/full\n\nRepeat the command to continue an interrupted campaign.");
  const auto options = std::make_shared<CampaignOptions>();
  CampaignConfig& config = options->config;
  AddSceneOptions(command, config.session);
  AddSearchOptions(command, config.optimise,
                   "evaluations per scene in step 2; as many as optimise uses (" +
                       std::to_string(OptimiseConfig().evaluations) + ") for the full campaign");
  command
      .AddOption("--trials", config.session.trials, "benchmark trials per scene and variant", "N")
      ->ShowDefault();
  command.AddFlag("--compare", options->compare,
                  "also compare search methods over several seeds, on " +
                      std::to_string(kComparedScenes.size()) + " scenes");
  AddSettingsOption(command, options->settings, "comparison.seeds=20");
  AddPlanOnlyOption(command, options->plan_only);
  AddJobsOption(command, options->num_workers);
  command.AddOption("--out", options->out, "folder", "DIR")->ShowDefault("results/campaign-HASH");
  AddResumeOption(command, options->resume);
  command.AddOption("--real", options->real,
                    "table of trials with real hands to compare with; graspbench new trials DIR "
                    "writes a template",
                    "FILE.csv");
  AddTrialTimeoutOption(command, options->trial_time_limit);
  AddJsonOption(command, options->json);
  command.SetAction([options, &command] {
    if (options->resume) {
      CheckResume(command, {"--hand", "--object", "--evaluations", "--fitness-trials", "--trials",
                            "--search", "--fitness", "--race", "--grip", "--grip-limit",
                            "--compare", "--set", "--plan-only"});
    }
    return Run(*options);
  });
}

}  // namespace graspbench
