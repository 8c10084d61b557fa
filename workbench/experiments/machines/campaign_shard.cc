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
    ShardResult optimised = Search(ListOptimisations(scenes_, request_.shard));
    optimised.goes_on = !HasSession(folder_ / "benchmark");
    if (optimised.num_left > 0 || optimised.goes_on) return optimised;
    ShardResult result;
    result.unit = "task";
    for (const bool judge : {false, true}) {
      const ShardResult done = Benchmark(judge);
      result.num_all += done.num_all;
      result.num_left += done.num_left;
      if (result.num_left > 0) return result;
    }
    const std::vector<ComparisonTask> searches = PlanComparison(config_, scenes_, folder_);
    const ShardResult compared = Search(ListComparisons(searches, request_.shard));
    result.num_all += compared.num_all;
    result.num_left += compared.num_left;
    return result;
  }

 private:
  ShardResult Benchmark(bool judge) {
    ShardRequest request = request_;
    request.folder = folder_ / "benchmark";
    request.judge = judge;
    request.time_budget = std::numeric_limits<double>::infinity();
    return WorkOnSession(request, AddSceneGrasps(inputs_, scenes_), budget_, budget_.stop());
  }

  ShardResult Search(const SearchRound& round) {
    ShardResult result;
    result.unit = "scene";
    result.num_all = round.num_all;
    result.num_left = static_cast<int>(round.left.size());
    if (round.left.empty()) return result;
    ShardPresence presence(folder_, FormatLabel(request_.shard), result.num_left);
    const SessionConfig& config = config_.session;
    const std::vector<PlannedTrial> sentinels =
        presence.ListMissingSentinels(MakePlan(config, inputs_));
    budget_.Look();
    if (presence.Begin(sentinels, config, inputs_, budget_, request_.trial_time_limit)) {
      result.num_left -= RunSearches(round, request_.num_workers, budget_, budget_.stop(),
                                     request_.trial_time_limit);
    }
    return result;
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
