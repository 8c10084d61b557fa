#include "workbench/experiments/run_campaign.h"

#include <algorithm>
#include <atomic>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/base/files/files.h"
#include "datasets/campaign/campaign_store.h"
#include "datasets/plan/session_inputs.h"
#include "datasets/session/judgement_store.h"
#include "datasets/session/merge_sessions.h"
#include "datasets/shards/worker_log.h"
#include "workbench/experiments/output_folder.h"
#include "workbench/experiments/pool/worker_pool.h"
#include "workbench/experiments/run_session.h"

namespace graspbench {

namespace fs = std::filesystem;

namespace {

class CampaignRun {
 public:
  CampaignRun(const CampaignRequest& request, Observer& observer)
      : config_(request.config ? *request.config : LoadCampaignConfig(request.folder)),
        num_workers_(request.num_workers),
        trial_time_limit_(request.trial_time_limit),
        folder_(request.folder),
        inputs_(LoadSessionInputs(config_.session, FieldUse::kNow,
                                  request.config ? fs::path() : folder_)),
        scenes_(PlanScenes(config_, inputs_, folder_)),
        observer_(observer) {
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
      CopyRehearsed(inputs_, staged.path());
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
    const int num_done = RunSearches(round, num_workers_, recorder, trial_time_limit_);
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
                                     num_workers_, observer_, trial_time_limit_);
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

int CountSearchesLeft(const fs::path& folder) {
  const CampaignConfig config = LoadCampaignConfig(folder);
  const SessionInputs inputs = LoadSessionInputs(config.session, FieldUse::kNow, folder);
  const std::vector<CampaignScene> scenes = PlanScenes(config, inputs, folder);
  return static_cast<int>(ListComparisons(PlanComparison(config, scenes, folder)).left.size());
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
                double trial_time_limit) {
  Stage stage = MakeStage(round.stage, round.left.size());
  stage.num_all = round.num_all;
  std::atomic<int> num_planned{0}, num_done{0};
  for (const LearningTask& task : round.left) num_planned += task.num_trials;
  stage.num_trials = num_planned;
  observer.BeginStage(stage);
  if (round.left.empty()) return 0;
  StatusBoard board(CalcNumWorkers(num_workers, round.left.size()));
  const auto make_runner = [&](int worker, const std::atomic<bool>& must_stop) -> RunTask {
    const auto pool = std::make_shared<TrialPool>(1, must_stop, trial_time_limit);
    return [&, worker, pool](size_t i) {
      const LearningTask& task = round.left[i];
      int num_trials = 0;
      task.run(*pool, [&](const LearningRequest& request, const LearningTrial& trial) {
        if (++num_trials > task.num_trials) ++num_planned;  // which was an estimate
        board.Count(trial.outcome);
        board.SetBusy(worker, PlannedTrial{"", task.hand, task.object,
                                           task.grasp + "  " + NameOf(request.stage),
                                           request.individual.number});
      });
      num_planned -= std::max(0, task.num_trials - num_trials);
      board.SetBusy(worker, std::nullopt);
      ++num_done;
    };
  };
  RunTasks(
      round.left.size(), num_workers, make_runner,
      [&] { observer.ShowStatus(board.Read(), num_planned); }, observer.stop());
  observer.EndStage();
  return num_done;
}

int PlanCampaign(const CampaignRequest& request) {
  Observer nobody;
  return CampaignRun(request, nobody).Plan();
}

int PlanBenchmark(const fs::path& folder) {
  Observer nobody;
  CampaignRequest request;
  request.folder = folder;
  return CampaignRun(request, nobody).PlanBenchmark();
}

bool RunCampaign(const CampaignRequest& request, Observer& observer) {
  return CampaignRun(request, observer).Run();
}

CampaignRest MergeCampaign(const fs::path& folder, const std::vector<fs::path>& others) {
  const fs::path benchmark = folder / "benchmark";
  MergeCampaigns(folder, others);
  CampaignRest rest;
  rest.scenes = PlanBenchmark(folder);
  if (!HasSession(benchmark)) {
    SealStore(kCampaignStore, folder);
    return rest;
  }
  std::vector<fs::path> sessions;
  for (const fs::path& other : others) {
    if (HasSession(other / "benchmark")) sessions.push_back(other / "benchmark");
  }
  MergeSessions(benchmark, sessions);
  const Session session = LoadSession(benchmark);
  SealStore(kSessionStore, benchmark);
  rest.trials = static_cast<int>(FindUnfinished(session).size());
  rest.judgements = static_cast<int>(FindUnjudged(session).size());
  rest.searches = CountSearchesLeft(folder);
  if (rest.trials + rest.judgements == 0) ExportSession(benchmark, session);
  SealStore(kCampaignStore, folder);
  return rest;
}

std::vector<std::string> DescribeCampaignMachines(const fs::path& folder) {
  Diagnostics ignored;
  std::vector<WorkerStart> starts = LoadWorkers(folder, ignored).starts;
  std::set<std::string> unchecked = FindUnchecked(folder, starts);
  if (HasSession(folder / "benchmark")) {
    const std::vector<WorkerStart> more = LoadWorkers(folder / "benchmark", ignored).starts;
    const std::set<std::string> others = FindUnchecked(folder / "benchmark", more);
    unchecked.insert(others.begin(), others.end());
    starts.insert(starts.end(), more.begin(), more.end());
  }
  std::vector<std::string> sentences = DescribeDifferences(starts);
  if (!unchecked.empty()) sentences.push_back(DescribeUnchecked(unchecked));
  return sentences;
}

}  // namespace graspbench
