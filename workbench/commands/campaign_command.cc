#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <filesystem>
#include <iostream>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "core/base/config.h"
#include "core/base/files.h"
#include "core/base/hash.h"
#include "core/base/text.h"
#include "core/statistics/proportion.h"
#include "core/statistics/summary.h"
#include "datasets/campaign/campaign_store.h"
#include "datasets/session/judgement_store.h"
#include "reports/campaign/campaign_report.h"
#include "workbench/commands/command.h"
#include "workbench/experiments/batch_runner.h"
#include "workbench/experiments/interrupt.h"
#include "workbench/experiments/learning_batch.h"
#include "workbench/experiments/run_record.h"
#include "workbench/experiments/session_worker.h"
#include "workbench/progress.h"
#include "workbench/text_table.h"

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
  bool compare = false;
  int num_workers = 1;
  std::string out;
};

class CampaignRun {
 public:
  CampaignRun(const CampaignOptions& options, fs::path folder)
      : config_(options.config),
        num_workers_(options.num_workers),
        folder_(std::move(folder)),
        inputs_(LoadSessionInputs(config_.session)),
        scenes_(PlanScenes(config_, inputs_, folder_)),
        stop_(CatchInterrupts()) {
    PlanComparison(config_, scenes_, folder_);  // its names must exist before hours are spent
  }

  void Run() {
    CreateCampaign(folder_, config_);
    OptimiseScenes();
    Benchmark();
    Compare();
  }

 private:
  void OptimiseScenes() {
    std::vector<LearningTask> tasks;
    for (const CampaignScene& scene : scenes_) {
      CreateScene(scene.folder, scene.config);
      if (IsSceneFinished(scene.folder)) continue;
      LearningTask task = MakeTask(scene, CountLearningTrials(config_.optimise));
      task.run = [&scene](TrialPool& pool, const ObserveLearning& observe) {
        RunScene(scene.folder, scene.config, scene.inputs, pool, observe);
      };
      tasks.push_back(std::move(task));
    }
    RunTasks("optimisation", tasks, scenes_.size());
  }

  void Compare() {
    const std::vector<ComparisonTask> searches = PlanComparison(config_, scenes_, folder_);
    std::vector<LearningTask> tasks;
    for (const ComparisonTask& search : searches) {
      const OptimiseConfig& optimise = search.config.optimise;
      LearningTask task = MakeTask(*search.scene, optimise.evaluations * optimise.fitness_trials);
      task.grasp = optimise.method + "-" + std::to_string(optimise.seed);
      task.run = [&search](TrialPool& pool, const ObserveLearning& observe) {
        RunComparisonSearch(search, pool, observe);
      };
      MakeFolder(search.journal.parent_path());
      tasks.push_back(std::move(task));
    }
    RunTasks("comparison", tasks, searches.size());
  }

  LearningTask MakeTask(const CampaignScene& scene, int num_trials) const {
    return {scene.inputs.hand->id, scene.inputs.object->id, scene.config.grasp, num_trials, {}};
  }

  void RunTasks(const char* stage, const std::vector<LearningTask>& tasks, size_t num_all) {
    if (num_all == 0) return;
    std::cerr << stage << ": " << num_all << " in all, " << num_all - tasks.size()
              << " finished before\n";
    if (tasks.empty()) return;
    Progress progress(stderr, 0, {});
    const bool is_complete = Record([&](RunRecord& record, const auto& seconds) {
      return RunLearningBatch(
          tasks, num_workers_,
          [&](const BatchStatus& status, int num_planned) {
            record.num_trials = status.num_done;
            progress.SetPlanned(num_planned);
            progress.Show(status, seconds());
          },
          stop_);
    });
    progress.Finish();
    CheckComplete(is_complete);
  }

  void Benchmark() {
    const fs::path folder = folder_ / "benchmark";
    const SessionConfig config = MakeBenchmarkConfig(config_);
    const SessionInputs inputs = AddSceneGrasps(inputs_, scenes_);
    const std::vector<PlannedTrial> plan = MakePlan(config, inputs);
    if (!HasSession(folder)) CreateSession(folder, config, plan);
    const Session session = LoadSession(folder);
    CheckSameSession(session, config, plan);
    const std::vector<PlannedTrial> trials = FindUnfinished(session);
    std::cerr << "benchmark: " << FormatCount(static_cast<int>(plan.size()), "trial") << " in all, "
              << plan.size() - trials.size() << " finished before\n";
    if (!trials.empty()) {
      std::map<Outcome, int> before;
      for (const TrialRecord& finished : session.records) ++before[finished.result.outcome];
      RunTrials(trials, Progress(stderr, static_cast<int>(plan.size()), before),
                MakeSessionWorkers(config, inputs, folder));
    }
    Judge(inputs);
    ExportSession(folder, LoadSession(folder));
  }

  /** Breaks what the benchmark held. */
  void Judge(const SessionInputs& inputs) {
    const fs::path folder = folder_ / "benchmark";
    const Session session = LoadSession(folder);
    const std::vector<PlannedTrial> trials = FindUnjudged(session);
    std::cerr << "judge: " << FormatCount(static_cast<int>(trials.size()), "held grasp")
              << " to break\n";
    if (trials.empty()) return;
    RunTrials(trials, Progress(stderr, static_cast<int>(trials.size()), {}),
              MakeJudgeWorkers(session, inputs, folder));
  }

  void RunTrials(const std::vector<PlannedTrial>& trials, Progress progress,
                 const MakeBatchWorker& make_worker) {
    const bool is_complete = Record([&](RunRecord& record, const auto& seconds) {
      return RunBatch(
          trials, num_workers_, make_worker,
          [&](const BatchStatus& status) {
            record.num_trials = status.num_done;
            progress.Show(status, seconds());
          },
          stop_);
    });
    progress.Finish();
    CheckComplete(is_complete);
  }

  /** Runs `work(record, seconds since its start)` and adds it to run.json. */
  template <class Work>
  bool Record(const Work& work) {
    RunRecord record;
    record.started_utc = FormatUtcNow();
    record.num_workers = num_workers_;
    const auto start = std::chrono::steady_clock::now();
    const auto seconds = [&] {
      return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    };
    const bool is_complete = work(record, seconds);
    record.duration = seconds();
    record.ending = is_complete ? "finished" : "interrupted";
    AppendRunRecord(folder_, record);
    return is_complete;
  }

  void CheckComplete(bool is_complete) const {
    if (is_complete) return;
    throw Error(ErrorKind::kInterrupted,
                "stopped; finished trials are kept, the same command with --out " +
                    folder_.string() + " continues");
  }

  const CampaignConfig& config_;
  int num_workers_;
  fs::path folder_;
  SessionInputs inputs_;
  std::vector<CampaignScene> scenes_;
  const std::atomic<bool>& stop_;
};

std::string FormatPercentage(double ratio) {
  return std::isfinite(ratio) ? FormatFixed(100.0 * ratio, 1) : "n/a";
}

void PrintVariants(const Campaign& campaign) {
  const std::vector<VariantSummary> summaries = SummariseVariants(campaign.benchmark);
  TextTable table({"variant", "scenes", "trials", "successes", "95 % interval [%]", "median sigma",
                   "median GFT%", "median GOT%", "median GCT [s]"});
  for (const char* variant : {"standard", "new-pregrasp", "new-target"}) {
    std::vector<double> sigma, gft, got, gct;
    int trials = 0, successes = 0;
    for (const VariantSummary& summary : summaries) {
      if (summary.variant != variant) continue;
      trials += summary.trials;
      successes += summary.successes;
      sigma.push_back(summary.mean_sigma);
      gft.push_back(summary.median_gft_ratio);
      got.push_back(summary.median_got_ratio);
      gct.push_back(summary.median_gct);
    }
    table.AddRow(
        {variant, std::to_string(sigma.size()), std::to_string(trials), std::to_string(successes),
         FormatRateInterval(successes, trials), FormatFixed(CalcMedianOfFinite(sigma), 3),
         FormatPercentage(CalcMedianOfFinite(gft)), FormatPercentage(CalcMedianOfFinite(got)),
         FormatFixed(CalcMedianOfFinite(gct), 3)});
  }
  std::cout << '\n' << table.Format();
}

void PrintComparison(const Campaign& campaign) {
  if (campaign.comparison.empty()) return;
  TextTable table(
      {"method", "searches", "median best fitness", "reached 90 %", "median evaluations to 90 %"});
  for (const std::string& method : campaign.config.comparison.methods) {
    std::vector<double> best, evaluations;
    for (const ComparisonRun& run : campaign.comparison) {
      if (run.method != method) continue;
      best.push_back(*std::max_element(run.fitness.begin(), run.fitness.end()));
      if (run.evaluations_to_90 > 0) evaluations.push_back(run.evaluations_to_90);
    }
    const double median = CalcMedianOfFinite(evaluations);
    table.AddRow({method, std::to_string(best.size()), FormatFixed(CalcMedianOfFinite(best), 3),
                  std::to_string(evaluations.size()),
                  std::isfinite(median) ? FormatFixed(median, 0) : "n/a"});
  }
  std::cout << '\n' << table.Format();
}

void RunCampaign(CampaignOptions options) {
  for (const std::string& setting : options.settings) SetConfigValue(setting, options.config);
  if (options.compare && options.config.comparison.scenes.empty()) {
    options.config.comparison.scenes = kComparedScenes;
  }
  CheckCampaignConfig(options.config);
  const std::string hash = CalcHashHex(FormatJson(ConfigToJson(options.config))).substr(0, 8);
  const fs::path folder =
      options.out.empty() ? fs::path("results") / ("campaign-" + hash) : fs::path(options.out);
  std::cerr << folder.string() << " on " << FormatCount(options.num_workers, "worker") << '\n';
  CampaignRun(options, folder).Run();
  const Campaign campaign = LoadCampaign(folder);
  ExportCampaign(folder, campaign);
  PrintVariants(campaign);
  PrintComparison(campaign);
  std::cout << "\nreport   " << WriteCampaignReport(folder, campaign).string() << "\ndata     "
            << (folder / "summary.csv").string() << '\n';
}

}  // namespace

void AddCampaignCommand(CLI::App& program, ExitCode&) {
  CLI::App& command = AddSubcommand(
      program, "campaign",
      "Optimises every hand and object, then tries all variants on the same poses.",
      "  graspbench campaign --out results/campaign                       200 evaluations a scene\n"
      "  graspbench campaign --evaluations 1000 --compare --out results/full\n\n"
      "The same command again continues what was interrupted.");
  const auto options = std::make_shared<CampaignOptions>();
  CampaignConfig& config = options->config;
  config.optimise.evaluations = 200;
  AddSceneOptions(command, config.session.hands, config.session.objects);
  command
      .add_option("--evaluations", config.optimise.evaluations,
                  "of each scene's step 2 (default 200; 1000 for the full campaign)")
      ->option_text("N");
  command
      .add_option("--fitness-trials", config.optimise.fitness_trials,
                  "trials of an evaluation: 1 without variation, or so many drawn ones (default " +
                      std::to_string(config.optimise.fitness_trials) + ")")
      ->option_text("N");
  command
      .add_option("--trials", config.session.trials,
                  "trials of each scene and variant in the benchmark (default 10)")
      ->option_text("N");
  command.add_flag("--compare", options->compare,
                   "also compare search methods over several seeds, on six scenes");
  AddSettingsOption(command, options->settings, "comparison.seeds=20");
  AddJobsOption(command, options->num_workers);
  command.add_option("--out", options->out, "folder (default: results/campaign-HASH)")
      ->option_text("DIR");
  command.callback([options] { RunCampaign(*options); });
}

}  // namespace graspbench
