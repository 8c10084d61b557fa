#include "workbench/experiments/run_shard.h"

#include <algorithm>
#include <chrono>
#include <map>
#include <memory>
#include <set>

#include "core/base/error.h"
#include "core/base/files.h"
#include "datasets/session/judgement_store.h"
#include "objects/catalogue.h"
#include "workbench/experiments/machine.h"
#include "workbench/experiments/session_worker.h"
#include "workbench/experiments/worker_pool.h"

namespace graspbench {
namespace fs = std::filesystem;

namespace {

/** Passes on what happens and asks to stop when somebody else does or when the time is over. */
class Budget : public Observer {
 public:
  Budget(double seconds, Observer& observer, const std::atomic<bool>& stop)
      : seconds_(seconds), observer_(observer), others_stop_(stop) {
    Look();
  }

  const std::atomic<bool>& stop() const { return stop_; }
  int num_done() const { return num_done_; }  ///< of the last stage

  void BeginStage(const Stage& stage) override {
    num_done_ = 0;
    observer_.BeginStage(stage);
  }
  void ShowStatus(const BatchStatus& status, int num_trials) override {
    num_done_ = status.num_done;
    Look();
    observer_.ShowStatus(status, num_trials);
  }
  void EndStage() override { observer_.EndStage(); }

  /** To be called now and then. */
  void Look() {
    const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start_;
    if (others_stop_ || time.count() >= seconds_) stop_ = true;
  }

 private:
  const double seconds_;
  Observer& observer_;
  const std::atomic<bool>& others_stop_;
  const std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::atomic<bool> stop_{false};
  int num_done_ = 0;
};

void CheckPhysics(const fs::path& folder) {
  const int physics =
      IntFrom(Json::parse(ReadFile(folder / kSessionStore.file)).at("physics_version"));
  if (physics == kPhysicsVersion) return;
  throw Error(ErrorKind::kVersion, "the session in \"" + folder.string() +
                                       "\" was planned with physics version " +
                                       std::to_string(physics) + ", this program has " +
                                       std::to_string(kPhysicsVersion) +
                                       "; work on it with the program that planned it");
}

void CheckBuild(const fs::path& folder) {
  const std::vector<std::string> builds = ListBuilds(folder);
  if (builds.empty() || std::find(builds.begin(), builds.end(), FindBuild()) != builds.end()) {
    return;
  }
  throw Error(ErrorKind::kVersion,
              "the session in \"" + folder.string() + "\" belongs to build " + builds.back() +
                  " of graspbench, this is build " + FindBuild() +
                  "; use that one on every machine, or --allow-build if their results are known to "
                  "be the same");
}

/** The inputs of a few trials: objects of the catalogue that none of them needs are not loaded.
@throws Error(kVersion) when the trials are no longer what they were planned to be. */
SessionInputs LoadInputsOf(const std::vector<PlannedTrial>& trials, SessionConfig config,
                           const fs::path& folder) {
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
  SessionInputs inputs = LoadSessionInputs(config, FieldUse::kLater, folder);
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
  return inputs;
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

class ShardWorker {
 public:
  ShardWorker(const ShardRequest& request, Observer& observer, const std::atomic<bool>& stop)
      : request_(request),
        folder_(request.folder),
        label_(FormatLabel(request.shard)),
        budget_(request.time_budget, observer, stop),
        session_(request.judge ? LoadSession(folder_, OnDamage::kRefuse, RecordParts::kBrief)
                               : LoadShardOfSession(folder_, label_)) {
    CheckPhysics(folder_);
    if (!request.allow_build) CheckBuild(folder_);
  }

  ShardResult Work() {
    const std::vector<PlannedTrial> own = DealPlan(session_.plan, request_.shard);
    const std::vector<PlannedTrial> trials =
        Intersect(request_.judge ? FindUnjudged(session_) : FindUnfinished(session_), own);
    ShardResult result;
    result.num_trials = static_cast<int>(request_.judge ? trials.size() : own.size());
    result.num_left = static_cast<int>(trials.size());
    if (trials.empty()) return result;
    WorkerLog log(folder_, label_);
    std::vector<PlannedTrial> sentinels;
    if (!HasWorkedHere()) sentinels = ListSentinels(session_.plan);
    std::vector<PlannedTrial> all = trials;
    all.insert(all.end(), sentinels.begin(), sentinels.end());
    inputs_ = LoadInputsOf(all, session_.config, folder_);
    budget_.Look();  // loading takes time, too
    if (!sentinels.empty() && !RunSentinels(sentinels, log)) return result;
    RunBatchStage(MakeStage(trials), trials, request_.num_workers,
                  request_.judge ? MakeJudgeWorkers(session_, inputs_, folder_, label_)
                                 : MakeSessionWorkers(session_.config, inputs_, folder_, label_),
                  budget_, budget_.stop(), request_.trial_time_limit);
    result.num_left -= budget_.num_done();
    return result;
  }

 private:
  bool HasWorkedHere() const {
    Diagnostics ignored;  // reported by LoadSession
    const std::vector<WorkerStart> starts = LoadWorkers(folder_, ignored, label_);
    return std::any_of(starts.begin(), starts.end(),
                       [&](const WorkerStart& start) { return start.machine == machine_; });
  }

  /** False: stopped before they were through, and nothing is kept. */
  bool RunSentinels(const std::vector<PlannedTrial>& sentinels, WorkerLog& log) {
    WorkerStart start{label_, FormatUtcNow(), machine_, {}};
    const auto runner = std::make_shared<PlannedTrialRunner>(session_.config, inputs_);
    const auto make_worker = [&start, runner](int) {
      return BatchWorker{
          [runner](const PlannedTrial& planned) { return runner->Run(planned); },
          [&start](const TrialRecord& record) { start.sentinels.push_back(record); }};
    };
    const auto show = [this](const BatchStatus&) { budget_.Look(); };
    if (!RunBatch(sentinels, 1, make_worker, show, budget_.stop(), request_.trial_time_limit)) {
      return false;
    }
    log.Append(start);
    return true;
  }

  Stage MakeStage(const std::vector<PlannedTrial>& trials) const {
    Stage stage;
    stage.name = request_.judge ? "judge" : "run";
    stage.num_all = stage.num_left = stage.num_trials = static_cast<int>(trials.size());
    return stage;
  }

  const ShardRequest request_;
  const fs::path folder_;
  const std::string label_;
  const Machine machine_ = FindMachine();
  Budget budget_;
  const Session session_;
  SessionInputs inputs_;
};

}  // namespace

ShardResult WorkOnShard(const ShardRequest& request, Observer& observer,
                        const std::atomic<bool>& stop) {
  auto worker = std::make_unique<ShardWorker>(request, observer, stop);
  const ShardResult result = worker->Work();
  if (HasAbandonedTasks()) static_cast<void>(worker.release());  // their threads still use it
  return result;
}

}  // namespace graspbench
