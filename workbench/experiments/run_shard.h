#pragma once
/** @file
One machine's part of a session that several work on. A worker reads configuration and plan, writes
journals of its own and nothing else; which trials are its own follows from the plan
(datasets/session/shard.h). The parts are put together by datasets/session/merge_sessions.h. */

#include <atomic>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include "datasets/session/shard.h"
#include "datasets/session/worker_log.h"
#include "workbench/experiments/observer.h"
#include "workbench/experiments/run_session.h"

namespace graspbench {

struct ShardRequest {
  std::filesystem::path folder;
  Shard shard;
  bool judge = false;        ///< break what its trials held, instead of running them
  bool allow_build = false;  ///< go on although another build made or began the session
  int num_workers = 1;
  double time_budget = std::numeric_limits<double>::infinity();  ///< of the clock [s]
  double trial_time_limit = kTrialTimeLimit;                     ///< [s]
};

struct ShardResult {
  int num_trials = 0;  ///< of the shard; with `judge` those that were not judged before
  int num_left = 0;    ///< not 0: `stop` was set or the time is over; the same request goes on
};

/** Runs the sentinel trials, once a machine, and then what is left of the shard; see worker_log.h.
@throws Error(kVersion) for another physics, build or plan, naming both; Error(kIo) when another
process works on the shard; Error(kUsage) for more shards than trials; as LoadSession. */
ShardResult WorkOnShard(const ShardRequest& request, Observer& observer,
                        const std::atomic<bool>& stop);

}  // namespace graspbench
