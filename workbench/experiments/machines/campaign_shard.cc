#include "workbench/experiments/machines/campaign_shard.h"

#include <algorithm>

#include "core/base/error.h"
#include "datasets/campaign/campaign_store.h"
#include "workbench/experiments/machines/run_shard.h"
#include "workbench/experiments/run_campaign.h"

namespace graspbench {
namespace fs = std::filesystem;

namespace {

class CampaignShard {
 public:
  CampaignShard(const ShardRequest& request, Observer& observer, const std::atomic<bool>& stop)
      : request_(request),
        folder_(request.folder),
        budget_(request.time_budget, observer, stop),
        config_(LoadCampaignConfig(folder_)),
        inputs_(LoadSessionInputs(config_.session, FieldUse::kNow, folder_)),
        scenes_(PlanScenes(config_, inputs_, folder_)) {
    CheckProgram(kCampaignStore, request);
    CheckSameScenes(folder_, scenes_);
  }

  ShardResult Work() {
    const ShardResult optimised = OptimiseScenes();
    if (optimised.num_left > 0 || optimised.goes_on) return optimised;
    ShardResult result;
    result.unit = "task";
    for (const bool judge : {false, true}) {
      const ShardResult done = Benchmark(judge);
      result.num_all += done.num_all;
      result.num_left += done.num_left;
      if (result.num_left > 0) return result;
    }
    const ShardResult compared = Compare();
    result.num_all += compared.num_all;
    result.num_left += compared.num_left;
    return result;
  }

 private:
  ShardResult OptimiseScenes() {
    ShardResult result;
    result.unit = "scene";
    result.goes_on = !HasSession(folder_ / "benchmark");
    std::vector<LearningTask> tasks;
    for (const CampaignScene& scene : scenes_) {
      if (!IsCardOf(FindSceneNumber(scenes_, scene), request_.shard)) continue;
      ++result.num_all;
      if (!IsSceneFinished(scene.folder, scene.inputs)) tasks.push_back(MakeSceneTask(scene));
    }
    Run(StageKind::kOptimisation, tasks, result);
    return result;
  }

  ShardResult Benchmark(bool judge) {
    ShardRequest request = request_;
    request.folder = folder_ / "benchmark";
    request.judge = judge;
    request.time_budget = std::numeric_limits<double>::infinity();
    return WorkOnSession(request, AddSceneGrasps(inputs_, scenes_), budget_, budget_.stop());
  }

  ShardResult Compare() {
    const std::vector<ComparisonTask> searches = PlanComparison(config_, scenes_, folder_);
    ShardResult result;
    std::vector<LearningTask> tasks;
    for (size_t i = 0; i < searches.size(); ++i) {
      if (!IsCardOf(i, request_.shard)) continue;
      ++result.num_all;
      if (!IsSearchFinished(searches[i])) tasks.push_back(MakeSearchTask(searches[i]));
    }
    Run(StageKind::kComparison, tasks, result);
    return result;
  }

  /** Adds what is left when it ends. */
  void Run(StageKind kind, const std::vector<LearningTask>& tasks, ShardResult& result) {
    if (tasks.empty()) return;
    result.num_left = static_cast<int>(tasks.size());
    ShardPresence presence(folder_, FormatLabel(request_.shard), result.num_left);
    const SessionConfig& config = config_.session;
    const std::vector<PlannedTrial> sentinels =
        presence.ListMissingSentinels(MakePlan(config, inputs_));
    budget_.Look();
    if (!presence.Begin(sentinels, config, inputs_, budget_, request_.trial_time_limit)) return;
    Stage stage;
    stage.kind = kind;
    stage.num_all = result.num_all;
    stage.num_left = result.num_left;
    for (const LearningTask& task : tasks) stage.num_trials += task.num_trials;
    budget_.BeginStage(stage);
    std::atomic<int> num_done{0};
    std::vector<LearningTask> counted = tasks;
    for (LearningTask& task : counted) {
      task.run = [run = task.run, &num_done](TrialPool& pool, const ObserveLearning& observe) {
        run(pool, observe);
        ++num_done;
      };
    }
    RunLearningBatch(counted, request_.num_workers, budget_, budget_.stop(),
                     request_.trial_time_limit);
    budget_.EndStage();
    result.num_left -= num_done;
  }

  const ShardRequest request_;
  const fs::path folder_;
  TimeBudget budget_;
  const CampaignConfig config_;
  const SessionInputs inputs_;
  const std::vector<CampaignScene> scenes_;
};

}  // namespace

ShardResult WorkOnCampaign(const ShardRequest& request, Observer& observer,
                           const std::atomic<bool>& stop) {
  return CampaignShard(request, observer, stop).Work();
}

int CountCampaignCards(const fs::path& folder) {
  const CampaignConfig config = LoadCampaignConfig(folder);
  const size_t num_variants = MakeBenchmarkConfig(config).grasps.size();
  return static_cast<int>(ListScenes(folder).size() * num_variants) * config.session.trials;
}

}  // namespace graspbench
