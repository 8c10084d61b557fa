#include "workbench/experiments/run_campaign.h"

#include <string>
#include <vector>

#include "core/base/files.h"
#include "datasets/session/judgement_store.h"
#include "workbench/experiments/learning_batch.h"
#include "workbench/experiments/output_folder.h"
#include "workbench/experiments/run_record.h"
#include "workbench/experiments/run_session.h"
#include "workbench/experiments/session_worker.h"

namespace graspbench {
namespace fs = std::filesystem;

namespace {

class CampaignRun {
 public:
  CampaignRun(const fs::path& folder, const CampaignConfig& config, int num_workers,
              Observer& observer, const std::atomic<bool>& stop)
      : config_(config),
        num_workers_(num_workers),
        folder_(folder),
        inputs_(LoadSessionInputs(config_.session)),
        scenes_(PlanScenes(config_, inputs_, folder_)),
        observer_(observer),
        stop_(stop) {
    PlanComparison(config_, scenes_, folder_);  // its names must exist before hours are spent
  }

  bool Run() {
    if (HasCampaign(folder_)) {
      CreateCampaign(folder_, config_);  // the same one, or an error
    } else {
      StagedFolder staged({folder_, "", false, {}});
      CreateCampaign(staged.path(), config_);
      staged.Commit();
    }
    return OptimiseScenes() && Benchmark() && Compare();
  }

 private:
  bool OptimiseScenes() {
    std::vector<LearningTask> tasks;
    for (const CampaignScene& scene : scenes_) {
      CreateScene(scene.folder, scene.config);
      if (IsSceneFinished(scene.folder, scene.inputs)) continue;
      LearningTask task = MakeTask(scene, CountLearningTrials(config_.optimise));
      task.run = [&scene](TrialPool& pool, const ObserveLearning& observe) {
        RunScene(scene.folder, scene.config, scene.inputs, pool, observe);
      };
      tasks.push_back(std::move(task));
    }
    return RunTasks("optimisation", tasks, scenes_.size());
  }

  bool Compare() {
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
    return tasks.empty() || RunTasks("comparison", tasks, searches.size());
  }

  LearningTask MakeTask(const CampaignScene& scene, int num_trials) const {
    return {scene.inputs.hand->id, scene.inputs.object->id, scene.config.grasp, num_trials, {}};
  }

  bool RunTasks(const char* name, const std::vector<LearningTask>& tasks, size_t num_all) {
    Stage stage;
    stage.name = name;
    stage.num_all = static_cast<int>(num_all);
    stage.num_left = static_cast<int>(tasks.size());
    for (const LearningTask& task : tasks) stage.num_trials += task.num_trials;
    observer_.BeginStage(stage);
    if (tasks.empty()) return true;
    RunRecorder recorder(folder_, num_workers_, observer_);
    const bool is_complete = RunLearningBatch(tasks, num_workers_, recorder, stop_);
    SealStore(kCampaignStore, folder_);
    recorder.EndStage();
    recorder.Keep(is_complete);
    return is_complete;
  }

  bool Benchmark() {
    const fs::path folder = folder_ / "benchmark";
    const SessionConfig config = MakeBenchmarkConfig(config_);
    const SessionInputs inputs = AddSceneGrasps(inputs_, scenes_);
    const std::vector<PlannedTrial> plan = MakePlan(config, inputs);
    if (!HasSession(folder)) CreateSession(folder, config, plan);
    SealStore(kCampaignStore, folder_);
    const Session session = LoadSession(folder);
    CheckSameSession(session, config, plan);
    const std::vector<PlannedTrial> trials = FindUnfinished(session);
    SealStore(kSessionStore, folder);
    const bool is_complete = Record(!trials.empty(), [&](Observer& observer) {
      return RunBatchStage(MakeSessionStage("benchmark", session, trials.size()), trials,
                           num_workers_, MakeSessionWorkers(config, inputs, folder), observer,
                           stop_, kTrialTimeLimit);
    });
    SealStore(kSessionStore, folder);
    if (!is_complete || !Judge(inputs)) return false;
    ExportSession(folder, LoadSession(folder));
    return true;
  }

  /** Breaks what the benchmark held. */
  bool Judge(const SessionInputs& inputs) {
    const fs::path folder = folder_ / "benchmark";
    const Session session = LoadSession(folder);
    return Record(!FindUnjudged(session).empty(), [&](Observer& observer) {
      return JudgeSession(session, inputs, folder, num_workers_, observer, stop_);
    });
  }

  /** Runs `work(observer)` and, where there is work to do, adds it to run.json. */
  template <class Work>
  bool Record(bool has_work, const Work& work) {
    RunRecorder recorder(folder_, num_workers_, observer_);
    const bool is_complete = work(recorder);
    if (has_work) recorder.Keep(is_complete);
    return is_complete;
  }

  const CampaignConfig& config_;
  int num_workers_;
  fs::path folder_;
  SessionInputs inputs_;
  std::vector<CampaignScene> scenes_;
  Observer& observer_;
  const std::atomic<bool>& stop_;
};

}  // namespace

bool RunCampaign(const fs::path& folder, const CampaignConfig& config, int num_workers,
                 Observer& observer, const std::atomic<bool>& stop) {
  return CampaignRun(folder, config, num_workers, observer, stop).Run();
}

}  // namespace graspbench
