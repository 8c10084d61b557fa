#include "workbench/experiments/machines/run_shard.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/base/files/files.h"
#include "core/base/text/text.h"
#include "datasets/analysis/conditions/threshold_summary.h"
#include "datasets/campaign/campaign_store.h"
#include "datasets/shards/worker_log.h"
#include "objects/catalogue.h"
#include "workbench/experiments/pool/batch_runner.h"
#include "workbench/experiments/pool/worker_pool.h"
#include "workbench/experiments/run_campaign.h"
#include "workbench/experiments/run_record.h"
#include "workbench/experiments/run_session.h"
#include "workbench/experiments/scene_runner.h"

namespace graspbench {

namespace fs = std::filesystem;

namespace {

/** Passes on what happens and asks to stop when somebody else does, or when the time is over and at
least one trial is finished: so the same request gets there in the end, however short its time. */
class TimeBudget : public Observer {
 public:
  TimeBudget(double seconds, Observer& observer)
      : Observer(stop_), seconds_(seconds), observer_(observer) {
    Look();
  }

  int num_done() const { return num_done_; }  ///< of the last stage

  void BeginStage(const Stage& stage) override {
    num_done_ = 0;
    observer_.BeginStage(stage);
  }
  void ShowStatus(const BatchStatus& status, int num_trials) override {
    num_done_ = status.num_done;
    has_progress_ = has_progress_ || num_done_ > 0;
    Look();
    observer_.ShowStatus(status, num_trials);
  }
  void EndStage() override { observer_.EndStage(); }

  /** To be called now and then. */
  void Look() {
    const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start_;
    if (observer_.stop() || (has_progress_ && time.count() >= seconds_)) stop_ = true;
  }

 private:
  const double seconds_;
  Observer& observer_;
  const std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::atomic<bool> stop_{false};
  int num_done_ = 0;
  bool has_progress_ = false;  // in any stage
};

/** Of sentinels, which are no part of the shard's progress. */
class TimeKeeper : public Observer {
 public:
  explicit TimeKeeper(TimeBudget& budget) : Observer(budget.stop()), budget_(budget) {}
  void ShowStatus(const BatchStatus&, int) override { budget_.Look(); }

 private:
  TimeBudget& budget_;
};

/** A worker at work on a shard: while it lives no other process is, and its file says so. */
class ShardPresence {
 public:
  /** @param num_left  read when the worker ends; must outlive this.
  @throws Error(kIo) when another process works on the shard. */
  ShardPresence(const std::filesystem::path& folder, const std::string& label, const int& num_left)
      : folder_(folder), label_(label), num_left_(num_left), log_(folder, label) {}
  ~ShardPresence() {
    try {
      log_.Append(WorkerEnd{label_, FormatUtcNow(), num_left_});
    } catch (const std::exception&) {  // a full disk has stopped the trials already
    }
  }
  ShardPresence(const ShardPresence&) = delete;
  ShardPresence& operator=(const ShardPresence&) = delete;

  /** The plan's sentinels, or none when this machine has run them. */
  std::vector<PlannedTrial> ListMissingSentinels(const std::vector<PlannedTrial>& plan) const {
    Diagnostics ignored;  // another reader reports them
    const std::vector<WorkerStart> starts = LoadWorkers(folder_, ignored).starts;
    return HasSentinels(starts, FindMachine(), plan) ? std::vector<PlannedTrial>()
                                                     : ListSentinels(plan);
  }

  /** Runs the sentinels and says that the worker begins.
  @returns false: stopped before they were through, and nothing is kept. */
  bool Begin(const std::vector<PlannedTrial>& sentinels, const SessionConfig& config,
             const SessionInputs& inputs, TimeBudget& budget, double trial_time_limit) {
    WorkerStart start{label_, FormatUtcNow(), FindMachine(), {}};
    const auto make_worker = [&](int) {
      return MakeTrialWorker(config, inputs, [&start](const TrialRecord& record) {
        start.sentinels.push_back(record);
      });
    };
    TimeKeeper keeper(budget);
    if (!RunBatch(MakeStage(StageKind::kRun, sentinels.size()), sentinels, 1, make_worker, keeper,
                  trial_time_limit)) {
      return false;
    }
    log_.Append(start);
    return true;
  }

 private:
  const std::filesystem::path folder_;
  const std::string label_;
  const int& num_left_;
  WorkerLog log_;
};

/** Leaves out the program's objects that no trial needs. */
void DropIdleObjects(const std::vector<PlannedTrial>& trials, SessionConfig& config) {
  std::set<std::string> needed;
  for (const PlannedTrial& planned : trials) needed.insert(planned.object);
  if (config.objects == std::vector<std::string>{"all"}) config.objects = ListObjects();
  const auto is_idle = [&](const std::string& name) {
    return needed.count(name) == 0 && ComesWithProgram(name);
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
  SessionShard(const ShardRequest& request, Observer& observer)
      : request_(request),
        folder_(request.folder),
        label_(FormatLabel(request.shard)),
        budget_(request.time_budget, observer),
        asks_records_(request.judge || request.explain),
        session_(asks_records_ ? LoadSession(folder_, OnDamage::kRefuse, RecordParts::kBrief)
                               : LoadShardOfSession(folder_, label_)),
        round_(request.judge     ? kJudgeRound
               : request.explain ? kExplainRound
                                 : FindTrialRound(session_.config)) {
    CheckProgram(kSessionStore, request);
  }

  ShardResult Work(const std::optional<SessionInputs>& inputs) {
    const std::vector<PlannedTrial> own = FindThresholdScale(session_.config)
                                              ? PartitionDraws(session_.plan, request_.shard)
                                              : PartitionPlan(session_.plan, request_.shard);
    std::vector<PlannedTrial> trials = Intersect(round_.find_left(session_), own);
    if (asks_records_) CheckSomeFinished(own);
    ShardResult result;
    result.num_all = static_cast<int>(asks_records_ ? trials.size() : own.size());
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
               round_.make_workers(session_, inputs_, folder_, label_), budget_,
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
    throw Error(ErrorKind::kUsage,
                "none of the shard's " + FormatCount(static_cast<int64_t>(own.size()), "trial") +
                    " has run, so there is nothing to " + (request_.judge ? "judge" : "explain") +
                    "; work on it without --" + (request_.judge ? "judge" : "explain") +
                    " first, then merge");
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
  const bool asks_records_;
  const Session session_;
  const RoundKind& round_;
  SessionInputs inputs_;
};

/** The same for a session. @param inputs  its hands, objects and grasps; none: those that its
configuration names, as far as the shard needs them. */
ShardResult WorkOnSession(const ShardRequest& request, const std::optional<SessionInputs>& inputs,
                          Observer& observer);

ShardResult WorkOnSession(const ShardRequest& request, const std::optional<SessionInputs>& inputs,
                          Observer& observer) {
  auto worker = std::make_unique<SessionShard>(request, observer);
  const ShardResult result = worker->Work(inputs);
  if (HasAbandonedTasks()) static_cast<void>(worker.release());  // their threads still use it
  return result;
}

/** One machine's part of a campaign. Scenes are partitioned first. When all are finished, a merge
plans the benchmark, as it needs their grasps; then the same shards take the benchmark's trials,
judge what they held, and run the searches that are compared. */
class CampaignShard {
 public:
  CampaignShard(const ShardRequest& request, Observer& observer)
      : request_(request),
        folder_(request.folder),
        budget_(request.time_budget, observer),
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
    return WorkOnSession(request, AddSceneGrasps(inputs_, scenes_), budget_);
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
      result.num_left -=
          RunSearches(round, request_.num_workers, budget_, request_.trial_time_limit);
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

/** An optimisation asks one question after the other, so one machine works on it. */
ShardResult WorkOnScene(const ShardRequest& request, Observer& observer) {
  CheckProgram(kSceneStore, request);
  SceneConfig config = LoadScene(request.folder).config;
  const SceneInputs inputs = LoadSceneInputs(config, request.folder);
  ShardResult result;
  result.unit = "scene";
  result.num_all = 1;
  if (IsSceneFinished(request.folder, inputs)) return result;
  TimeBudget budget(request.time_budget, observer);
  try {
    RunSceneStage(request.folder, config, inputs, request.num_workers, budget,
                  request.trial_time_limit);
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::kInterrupted) throw;
    result.num_left = 1;
  }
  return result;
}

}  // namespace

void CheckProgram(const StoreKind& kind, const ShardRequest& request) {
  const std::string what = std::string("the ") + kind.name + " in \"" + request.folder.string();
  const int physics =
      IntFrom(Json::parse(ReadFile(request.folder / kind.file)).at("physics_version"));
  if (physics != kPhysicsVersion) {
    throw Error(ErrorKind::kVersion, what + "\" was planned with physics version " +
                                         std::to_string(physics) + ", this program has " +
                                         std::to_string(kPhysicsVersion) +
                                         "; work on it with the program that planned it");
  }
  const std::vector<std::string> builds = ListBuilds(request.folder);
  if (request.allow_build || builds.empty() ||
      std::find(builds.begin(), builds.end(), FindBuild()) != builds.end()) {
    return;
  }
  throw Error(ErrorKind::kVersion, what + "\" belongs to build " + builds.back() +
                                       " of graspbench, this is build " + FindBuild() +
                                       "; use that build on every machine, or --allow-build if the "
                                       "results are known to be equal");
}

int CountCards(const fs::path& folder) {
  const StoreKind* kind = FindStoreKind(folder);
  if (kind == &kSceneStore) return 1;
  if (kind == &kCampaignStore) {  // the trials of its benchmark
    const CampaignConfig config = LoadCampaignConfig(folder);
    const size_t num_variants = MakeBenchmarkConfig(config).grasps.size();
    return static_cast<int>(ListScenes(folder).size() * num_variants) * config.session.trials;
  }
  const Session session = LoadPlannedSession(folder);
  return FindThresholdScale(session.config) ? CountDraws(session.plan)
                                            : static_cast<int>(session.plan.size());
}

void CheckRequest(const ShardRequest& request) {
  const StoreKind* kind = FindStoreKind(request.folder);
  const bool is_campaign = kind == &kCampaignStore, is_scene = kind == &kSceneStore;
  if (request.judge && request.explain) {
    throw Error(ErrorKind::kUsage,
                "--judge and --explain are separate rounds; run one after the other");
  }
  if (request.explain && (is_campaign || is_scene)) {
    throw Error(ErrorKind::kUsage,
                "--explain is for sessions, and \"" + request.folder.string() +
                    "\" is not a session; for a campaign, explain its benchmark");
  }
  if (request.judge && (is_campaign || is_scene)) {
    throw Error(ErrorKind::kUsage,
                "--judge is for sessions, and \"" + request.folder.string() + "\" holds " +
                    (is_campaign ? "a campaign, whose benchmark is judged automatically"
                                 : "an optimisation"));
  }
  const int num_cards = CountCards(request.folder);
  if (request.shard.count <= num_cards) return;
  const std::string unit = is_scene ? "scene" : is_campaign ? "benchmark trial" : "trial";
  throw Error(ErrorKind::kUsage, FormatCount(request.shard.count, "shard") + " of " +
                                     FormatCount(num_cards, unit) +
                                     ": expected at most as many shards as " + unit + "s");
}

ShardResult WorkOnShard(const ShardRequest& request, Observer& observer) {
  const StoreKind* kind = FindStoreKind(request.folder);
  if (kind != &kCampaignStore && kind != &kSceneStore) {
    return WorkOnSession(request, std::nullopt, observer);
  }
  CheckRequest(request);
  return kind == &kCampaignStore ? CampaignShard(request, observer).Work()
                                 : WorkOnScene(request, observer);
}

}  // namespace graspbench
