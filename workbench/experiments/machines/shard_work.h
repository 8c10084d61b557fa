#pragma once
/** @file
What every shard does around its trials, whatever they belong to: it looks whether this program may
work on them, says in its file that it begins and ends (datasets/shards/worker_log.h), runs the
sentinel trials, and keeps to its time. */

#include <atomic>
#include <chrono>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include "datasets/shards/shard.h"
#include "datasets/shards/worker_log.h"
#include "workbench/experiments/observer.h"
#include "workbench/experiments/run_session.h"

namespace graspbench {

struct ShardRequest {
  std::filesystem::path folder;
  Shard shard;
  bool judge = false;        ///< of a session: break what its trials held, instead of running them
  bool allow_build = false;  ///< go on although another build made or began it
  int num_workers = 1;
  double time_budget = std::numeric_limits<double>::infinity();  ///< of the clock [s]
  double trial_time_limit = kTrialTimeLimit;                     ///< [s]
};

struct ShardResult {
  int num_all = 0;   ///< of the shard; with `judge` those that were not judged before
  int num_left = 0;  ///< not 0: `stop` was set or the time is over; the same request goes on
  std::string unit = "trial";
  /** After the next merge there is more to do: the benchmark of a campaign. */
  bool goes_on = false;
};

/** Passes on what happens and asks to stop when somebody else does, or when the time is over and at
least one trial is finished: so the same request gets there in the end, however short its time. */
class TimeBudget : public Observer {
 public:
  TimeBudget(double seconds, Observer& observer, const std::atomic<bool>& stop)
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
    has_progress_ = has_progress_ || num_done_ > 0;
    Look();
    observer_.ShowStatus(status, num_trials);
  }
  void EndStage() override { observer_.EndStage(); }

  /** To be called now and then. */
  void Look() {
    const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start_;
    if (others_stop_ || (has_progress_ && time.count() >= seconds_)) stop_ = true;
  }

 private:
  const double seconds_;
  Observer& observer_;
  const std::atomic<bool>& others_stop_;
  const std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::atomic<bool> stop_{false};
  int num_done_ = 0;
  bool has_progress_ = false;  // in any stage
};

/** @throws Error(kVersion) for another physics or, unless it is allowed, another build of the
program than the one that made or began what is in the folder, naming both. */
void CheckProgram(const StoreKind& kind, const ShardRequest& request);

/** A worker at work on a shard: while it lives no other process is, and its file says so. */
class ShardPresence {
 public:
  /** @param num_left  read when the worker ends; must outlive this.
  @throws Error(kIo) when another process works on the shard. */
  ShardPresence(const std::filesystem::path& folder, const std::string& label, const int& num_left)
      : folder_(folder), label_(label), num_left_(num_left), log_(folder, label) {}
  ~ShardPresence();
  ShardPresence(const ShardPresence&) = delete;
  ShardPresence& operator=(const ShardPresence&) = delete;

  /** The plan's sentinels, or none when this machine has run them. */
  std::vector<PlannedTrial> ListMissingSentinels(const std::vector<PlannedTrial>& plan) const;

  /** Runs the sentinels and says that the worker begins.
  @returns false: stopped before they were through, and nothing is kept. */
  bool Begin(const std::vector<PlannedTrial>& sentinels, const SessionConfig& config,
             const SessionInputs& inputs, TimeBudget& budget, double trial_time_limit);

 private:
  const std::filesystem::path folder_;
  const std::string label_;
  const int& num_left_;
  WorkerLog log_;
};

}  // namespace graspbench
