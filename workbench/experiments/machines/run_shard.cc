#include "workbench/experiments/machines/run_shard.h"

#include <algorithm>
#include <map>
#include <memory>
#include <set>

#include "core/base/error.h"
#include "core/base/text/text.h"
#include "datasets/analysis/conditions/threshold_summary.h"
#include "datasets/campaign/campaign_store.h"
#include "objects/catalogue.h"
#include "workbench/experiments/machines/campaign_shard.h"
#include "workbench/experiments/pool/worker_pool.h"
#include "workbench/experiments/run_session.h"
#include "workbench/experiments/scene_runner.h"

namespace graspbench {
namespace fs = std::filesystem;

namespace {

/** Leaves out the objects of the catalogue that no trial needs. */
void DropIdleObjects(const std::vector<PlannedTrial>& trials, SessionConfig& config) {
  std::set<std::string> needed;
  for (const PlannedTrial& planned : trials) needed.insert(planned.object);
  const std::vector<std::string> catalogue = ListObjects();
  if (config.objects == std::vector<std::string>{"all"}) config.objects = catalogue;
  const auto is_idle = [&](const std::string& name) {
    return needed.count(name) == 0 &&
           std::find(catalogue.begin(), catalogue.end(), name) != catalogue.end();
  };
  config.objects.erase(std::remove_if(config.objects.begin(), config.objects.end(), is_idle),
                       config.objects.end());
}

/** @throws Error(kVersion) when the trials are no longer what they were planned to be. */
void CheckSameTrials(const std::vector<PlannedTrial>& trials, const SessionConfig& config,
                     const SessionInputs& inputs) {
  std::map<std::string, std::string> ids;
  for (const PlannedTrial& planned : MakePlan(config, inputs))
    ids[DescribeTrial(planned)] = planned.id;
  for (const PlannedTrial& planned : trials) {
    const auto now = ids.find(DescribeTrial(planned));
    if (now != ids.end() && now->second == planned.id) continue;
    throw Error(ErrorKind::kVersion,
                "the trial " + DescribeTrial(planned) + " is " + planned.id + " in the plan and " +
                    (now == ids.end() ? "unknown" : now->second) +
                    " to this program: a hand, an object or a grasp differs from those of the "
                    "machine that planned the session");
  }
}

/** Those of `trials` that are among `some`, in their order. */
std::vector<PlannedTrial> Intersect(const std::vector<PlannedTrial>& trials,
                                    const std::vector<PlannedTrial>& some) {
  std::set<std::string> ids;
  for (const PlannedTrial& planned : some) ids.insert(planned.id);
  std::vector<PlannedTrial> common;
  for (const PlannedTrial& planned : trials) {
    if (ids.count(planned.id) > 0) common.push_back(planned);
  }
  return common;
}

class SessionShard {
 public:
  SessionShard(const ShardRequest& request, Observer& observer, const std::atomic<bool>& stop)
      : request_(request),
        folder_(request.folder),
        label_(FormatLabel(request.shard)),
        budget_(request.time_budget, observer, stop),
        session_(request.judge ? LoadSession(folder_, OnDamage::kRefuse, RecordParts::kBrief)
                               : LoadShardOfSession(folder_, label_)),
        round_(request.judge ? kJudgeRound : FindTrialRound(session_.config)) {
    CheckProgram(kSessionStore, request);
  }

  ShardResult Work(const std::optional<SessionInputs>& inputs) {
    const std::vector<PlannedTrial> own = FindThresholdScale(session_.config)
                                              ? PartitionDraws(session_.plan, request_.shard)
                                              : PartitionPlan(session_.plan, request_.shard);
    std::vector<PlannedTrial> trials = Intersect(round_.find_left(session_), own);
    if (request_.judge) CheckSomeFinished(own);
    ShardResult result;
    result.num_all = static_cast<int>(request_.judge ? trials.size() : own.size());
    result.num_left = static_cast<int>(trials.size());
    result.unit = round_.unit;
    const std::string label = round_.label + label_;
    if (trials.empty() && !IsUnchecked(label)) return result;
    ShardPresence presence(folder_, label, result.num_left);
    const std::vector<PlannedTrial> sentinels = presence.ListMissingSentinels(session_.plan);
    LoadInputs(inputs, &round_ == &kThresholdRound ? own : trials, sentinels);
    budget_.Look();  // loading takes time, too
    if (!presence.Begin(sentinels, session_.config, inputs_, budget_, request_.trial_time_limit)) {
      return result;
    }
    while (!trials.empty()) {
      RunBatch(MakeStage(round_.stage, trials.size()), trials, request_.num_workers,
               round_.make_workers(session_, inputs_, folder_, label_), budget_, budget_.stop(),
               request_.trial_time_limit);
      result.num_left -= budget_.num_done();
      if (result.num_left > 0 || &round_ != &kThresholdRound) break;
      trials = Intersect(round_.find_left(LoadShardOfSession(folder_, label_)), own);
      result.num_left = static_cast<int>(trials.size());
    }
    return result;
  }

 private:
  /** A finished shard whose machine's sentinels are lost makes them up. */
  bool IsUnchecked(const std::string& label) const {
    Diagnostics ignored;  // a merge reports them
    const std::vector<WorkerStart> starts = LoadWorkers(folder_, ignored).starts;
    return FindUnchecked(folder_, starts).count(label) > 0;
  }

  void CheckSomeFinished(const std::vector<PlannedTrial>& own) const {
    if (own.empty() || Intersect(FindUnfinished(session_), own).size() < own.size()) return;
    throw Error(ErrorKind::kUsage, "none of the shard's " +
                                       FormatCount(static_cast<int64_t>(own.size()), "trial") +
                                       " has run, so that there is nothing to judge; work on it "
                                       "without --judge first, then merge");
  }

  void LoadInputs(const std::optional<SessionInputs>& inputs,
                  const std::vector<PlannedTrial>& trials,
                  const std::vector<PlannedTrial>& sentinels) {
    std::vector<PlannedTrial> all = trials;
    all.insert(all.end(), sentinels.begin(), sentinels.end());
    SessionConfig config = session_.config;
    if (!inputs) DropIdleObjects(all, config);
    inputs_ = inputs ? *inputs : LoadSessionInputs(config, FieldUse::kLater, folder_);
    CheckSameTrials(all, config, inputs_);
  }

  const ShardRequest request_;
  const fs::path folder_;
  const std::string label_;
  TimeBudget budget_;
  const Session session_;
  const RoundKind& round_;
  SessionInputs inputs_;
};

/** An optimisation asks one question after the other, so one machine works on it. */
ShardResult WorkOnScene(const ShardRequest& request, Observer& observer,
                        const std::atomic<bool>& stop) {
  CheckProgram(kSceneStore, request);
  SceneConfig config = LoadScene(request.folder).config;
  const SceneInputs inputs = LoadSceneInputs(config, request.folder);
  ShardResult result;
  result.unit = "scene";
  result.num_all = 1;
  if (IsSceneFinished(request.folder, inputs)) return result;
  TimeBudget budget(request.time_budget, observer, stop);
  try {
    RunSceneStage(request.folder, config, inputs, request.num_workers, budget, budget.stop(),
                  request.trial_time_limit);
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::kInterrupted) throw;
    result.num_left = 1;
  }
  return result;
}

}  // namespace

int CountCards(const fs::path& folder) {
  const StoreKind* kind = FindStoreKind(folder);
  if (kind == &kSceneStore) return 1;
  if (kind == &kCampaignStore) return CountCampaignCards(folder);
  const Session session = LoadPlannedSession(folder);
  return FindThresholdScale(session.config) ? CountDraws(session.plan)
                                            : static_cast<int>(session.plan.size());
}

void CheckRequest(const ShardRequest& request) {
  const StoreKind* kind = FindStoreKind(request.folder);
  const bool is_campaign = kind == &kCampaignStore, is_scene = kind == &kSceneStore;
  if (request.judge && (is_campaign || is_scene)) {
    throw Error(ErrorKind::kUsage,
                "--judge is for sessions, and \"" + request.folder.string() + "\" holds " +
                    (is_campaign ? "a campaign; its benchmark is judged without being asked"
                                 : "an optimisation"));
  }
  const int num_cards = CountCards(request.folder);
  if (request.shard.count <= num_cards) return;
  const std::string unit = is_scene ? "scene" : is_campaign ? "benchmark trial" : "trial";
  throw Error(ErrorKind::kUsage, FormatCount(request.shard.count, "shard") + " of " +
                                     FormatCount(num_cards, unit) +
                                     ": expected at most as many shards as " + unit + "s");
}

ShardResult WorkOnSession(const ShardRequest& request, const std::optional<SessionInputs>& inputs,
                          Observer& observer, const std::atomic<bool>& stop) {
  auto worker = std::make_unique<SessionShard>(request, observer, stop);
  const ShardResult result = worker->Work(inputs);
  if (HasAbandonedTasks()) static_cast<void>(worker.release());  // their threads still use it
  return result;
}

ShardResult WorkOnShard(const ShardRequest& request, Observer& observer,
                        const std::atomic<bool>& stop) {
  const StoreKind* kind = FindStoreKind(request.folder);
  if (kind != &kCampaignStore && kind != &kSceneStore) {
    return WorkOnSession(request, std::nullopt, observer, stop);
  }
  CheckRequest(request);
  return kind == &kCampaignStore ? WorkOnCampaign(request, observer, stop)
                                 : WorkOnScene(request, observer, stop);
}

}  // namespace graspbench
