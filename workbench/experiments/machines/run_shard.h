#pragma once
/** @file
One machine's share of work that several machines do. A worker reads configuration and plan, and
writes only its own journals; its trials follow from the plan (datasets/shards/shard.h). Before its
trials it checks whether this program may work on them and runs the sentinel trials. It logs its
start and end (datasets/shards/worker_log.h), and respects its time budget. */

#include <filesystem>
#include <limits>
#include <string>

#include "datasets/shards/shard.h"
#include "workbench/experiments/observer.h"
#include "workbench/experiments/run_session.h"

namespace graspbench {

struct ShardRequest {
  std::filesystem::path folder;
  Shard shard;
  bool judge = false;        ///< sessions: break held grasps instead of running trials
  bool explain = false;      ///< sessions: explain one failure per condition instead
  bool allow_build = false;  ///< continue although another build created or began it
  int num_workers = 1;
  double time_budget = std::numeric_limits<double>::infinity();  ///< wall-clock time [s]
  double trial_time_limit = kTrialTimeLimit;                     ///< [s]
};

struct ShardResult {
  int num_all = 0;   ///< tasks of the shard; with `judge` or `explain` those open at the start
  int num_left = 0;  ///< not 0: stopped or out of time; repeating the request continues
  std::string unit = "trial";
  /** Whether more work follows after the next merge: the benchmark of a campaign. */
  bool goes_on = false;
};

/** Runs the sentinel trials, unless this machine has run them, and then the rest of the shard; see
worker_log.h. The folder holds a session, a campaign or an optimisation. An optimisation is
sequential and has only one shard.
@throws Error(kVersion) for another physics, build or plan, naming both; Error(kIo) when another
process works on the shard; Error(kUsage) for more shards than trials, and for results without
shards; as LoadSession. */
ShardResult WorkOnShard(const ShardRequest& request, Observer& observer);

/** Maximum number of shards that a folder can be partitioned into. @throws as WorkOnShard. */
int CountCards(const std::filesystem::path& folder);
/** @throws Error(kUsage) when the request has more shards, or demands work that the folder does not
need. */
void CheckRequest(const ShardRequest& request);

/** @throws Error(kVersion) for another physics or, unless it is allowed, another build of the
program than the one that created or began the folder's content, naming both. */
void CheckProgram(const StoreKind& kind, const ShardRequest& request);

}  // namespace graspbench
