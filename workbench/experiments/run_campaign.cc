#include "workbench/experiments/run_campaign.h"

#include <algorithm>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/base/files/files.h"
#include "datasets/plan/input_copies.h"
#include "workbench/experiments/output_folder.h"
#include "workbench/experiments/pool/learning_batch.h"
#include "workbench/experiments/run_session.h"

namespace graspbench {
namespace fs = std::filesystem;

namespace {

class CampaignRun {
 public:
  CampaignRun(const CampaignRequest& request, Observer& observer, const std::atomic<bool>& stop)
      : config_(request.config ? *request.config : LoadCampaignConfig(request.folder)),
        num_workers_(request.num_workers),
        trial_time_limit_(request.trial_time_limit),
        folder_(request.folder),
        inputs_(LoadSessionInputs(config_.session, FieldUse::kNow,
                                  request.config ? fs::path() : folder_)),
        scenes_(PlanScenes(config_, inputs_, folder_)),
        observer_(observer),
        stop_(stop) {
    PlanComparison(config_, scenes_, folder_);  // its names must exist before hours are spent
    if (!request.real.empty()) ReadReal(request.real);
  }

  bool Run() {
    Plan();
    return Search(ListOptimisations(scenes_)) && Benchmark() && Compare();
  }

  int Plan() {
    if (HasCampaign(folder_)) {
      CreateCampaign(folder_, config_);  // the same one, or an error
    } else {
      StagedFolder staged({folder_, "", false, {}});
      CopyInputs(config_.session, staged.path());
      CreateCampaign(staged.path(), config_);
      staged.Commit();
    }
    for (const CampaignScene& scene : scenes_) CreateScene(scene.folder, scene.config);
    SealScenes(folder_, scenes_);
    if (!real_.empty()) KeepRealTrials(folder_, real_);
    return static_cast<int>(scenes_.size());
  }

  /** @returns the scenes that are not finished. */
  int PlanBenchmark() {
    const auto is_unfinished = [](const CampaignScene& scene) {
      return !IsSceneFinished(scene.folder, scene.inputs);
    };
    const auto num_left = std::count_if(scenes_.begin(), scenes_.end(), is_unfinished);
    if (num_left > 0 || HasSession(folder_ / "benchmark")) return static_cast<int>(num_left);
    const SessionConfig config = MakeBenchmarkConfig(config_);
    CreateSession(folder_ / "benchmark", config,
                  MakePlan(config, AddSceneGrasps(inputs_, scenes_)));
    SealStore(kCampaignStore, folder_);
    return 0;
  }

 private:
  void ReadReal(const fs::path& file) {
    real_ = ReadFile(file);
    Diagnostics problems;
    CheckRealTrials(ReadRealTrials(real_, file.string(), problems), file.string(), inputs_,
                    problems);
    problems.ThrowIfErrors(ErrorKind::kFormat, "the trials with real hands cannot be used");
  }

  /** @pre what the round was made of outlives this. */
  bool Search(const SearchRound& round) {
    RunRecorder recorder(folder_, num_workers_, observer_);
    const int num_done = RunSearches(round, num_workers_, recorder, stop_, trial_time_limit_);
    if (round.left.empty()) return true;
    SealStore(kCampaignStore, folder_);
    const bool is_complete = num_done == static_cast<int>(round.left.size());
    recorder.Keep(is_complete);
    return is_complete;
  }

  bool Compare() {
    const std::vector<ComparisonTask> searches = PlanComparison(config_, scenes_, folder_);
    return searches.empty() || Search(ListComparisons(searches));
  }

  bool Benchmark() {
    const fs::path folder = folder_ / "benchmark";
    PlanBenchmark();
    const SessionConfig config = MakeBenchmarkConfig(config_);
    const SessionInputs inputs = AddSceneGrasps(inputs_, scenes_);
    CheckSameSession(LoadPlannedSession(folder), config, MakePlan(config, inputs));
    for (const RoundKind& round : {kBenchmarkRound, kJudgeRound}) {
      const RunRecord run = RunRound(round, {config, inputs, folder, LoadSession(folder)},
                                     num_workers_, observer_, stop_, trial_time_limit_);
      if (run.ending != RunEnding::kFinished) return false;
    }
    ExportSession(folder, LoadSession(folder));
    return true;
  }

  const CampaignConfig config_;
  const int num_workers_;
  const double trial_time_limit_;
  fs::path folder_;
  SessionInputs inputs_;
  std::vector<CampaignScene> scenes_;
  std::string real_;  ///< the table of real trials; empty: none given
  Observer& observer_;
  const std::atomic<bool>& stop_;
};

LearningTask MakeSceneTask(const CampaignScene& scene) {
  return {scene.inputs.hand->id, scene.inputs.object->id, scene.config.grasp,
          CountLearningTrials(scene.config.optimise),
          [&scene](TrialPool& pool, const ObserveLearning& observe) {
            RunScene(scene.folder, scene.config, scene.inputs, pool, observe);
          }};
}

LearningTask MakeSearchTask(const ComparisonTask& search) {
  const OptimiseConfig& optimise = search.config.optimise;
  return {search.scene->inputs.hand->id, search.scene->inputs.object->id,
          optimise.method + "-" + std::to_string(optimise.seed),
          optimise.evaluations * optimise.fitness_trials,
          [&search](TrialPool& pool, const ObserveLearning& observe) {
            MakeFolder(search.journal.parent_path());
            RunComparisonSearch(search, pool, observe);
          }};
}

/** Whether its journal holds all answers: they are given again, and nothing is simulated. */
bool IsSearchFinished(const ComparisonTask& search) {
  if (!fs::exists(search.journal)) return false;
  const std::atomic<bool> simulate_nothing{true};
  TrialPool pool(1, simulate_nothing);
  try {
    RunComparisonSearch(search, pool, [](const LearningRequest&, const LearningTrial&) {});
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::kInterrupted) throw;
    return false;
  }
  return true;
}

}  // namespace

SearchRound ListOptimisations(const std::vector<CampaignScene>& scenes, const Shard& shard) {
  SearchRound round;
  for (const CampaignScene& scene : scenes) {
    if (!IsCardOf(FindSceneNumber(scenes, scene), shard)) continue;
    ++round.num_all;
    if (!IsSceneFinished(scene.folder, scene.inputs)) round.left.push_back(MakeSceneTask(scene));
  }
  return round;
}

SearchRound ListComparisons(const std::vector<ComparisonTask>& searches, const Shard& shard) {
  SearchRound round;
  round.stage = StageKind::kComparison;
  for (size_t i = 0; i < searches.size(); ++i) {
    if (!IsCardOf(i, shard)) continue;
    ++round.num_all;
    if (!IsSearchFinished(searches[i])) round.left.push_back(MakeSearchTask(searches[i]));
  }
  return round;
}

int RunSearches(const SearchRound& round, int num_workers, Observer& observer,
                const std::atomic<bool>& stop, double trial_time_limit) {
  Stage stage = MakeStage(round.stage, round.left.size());
  stage.num_all = round.num_all;
  stage.num_trials = 0;
  std::atomic<int> num_done{0};
  std::vector<LearningTask> counted = round.left;
  for (LearningTask& task : counted) {
    stage.num_trials += task.num_trials;
    task.run = [run = task.run, &num_done](TrialPool& pool, const ObserveLearning& observe) {
      run(pool, observe);
      ++num_done;
    };
  }
  observer.BeginStage(stage);
  if (counted.empty()) return 0;
  RunLearningBatch(counted, num_workers, observer, stop, trial_time_limit);
  observer.EndStage();
  return num_done;
}

int PlanCampaign(const CampaignRequest& request) {
  Observer nobody;
  const std::atomic<bool> stop{false};
  return CampaignRun(request, nobody, stop).Plan();
}

int PlanBenchmark(const fs::path& folder) {
  Observer nobody;
  const std::atomic<bool> stop{false};
  CampaignRequest request;
  request.folder = folder;
  return CampaignRun(request, nobody, stop).PlanBenchmark();
}

bool RunCampaign(const CampaignRequest& request, Observer& observer,
                 const std::atomic<bool>& stop) {
  return CampaignRun(request, observer, stop).Run();
}

}  // namespace graspbench
