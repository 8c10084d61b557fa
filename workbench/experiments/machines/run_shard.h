#pragma once
/** @file
One machine's part of what several work on. A worker reads configuration and plan, writes journals
of its own and nothing else; which trials are its own follows from the plan
(datasets/shards/shard.h). Around its trials it looks whether this program may work on them, says in
its file that it begins and ends (datasets/shards/worker_log.h), runs the sentinel trials, and keeps
to its time. */

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
  bool judge = false;        ///< of a session: break what its trials held, instead of running them
  bool explain = false;      ///< of a session: explain one failure of each condition, instead
  bool allow_build = false;  ///< go on although another build made or began it
  int num_workers = 1;
  double time_budget = std::numeric_limits<double>::infinity();  ///< of the clock [s]
  double trial_time_limit = kTrialTimeLimit;                     ///< [s]
};

struct ShardResult {
  int num_all = 0;   ///< of the shard; with `judge` or `explain` those that were not before
  int num_left = 0;  ///< not 0: it was stopped or the time is over; the same request goes on
  std::string unit = "trial";
  /** After the next merge there is more to do: the benchmark of a campaign. */
  bool goes_on = false;
};

/** Runs the sentinel trials, unless its machine has, and then what is left of the shard; see
worker_log.h. The folder holds a session, a campaign or an optimisation, which is
one chain and has one shard only.
@throws Error(kVersion) for another physics, build or plan, naming both; Error(kIo) when another
process works on the shard; Error(kUsage) for more shards than trials, and for what has no shards;
as LoadSession. */
ShardResult WorkOnShard(const ShardRequest& request, Observer& observer);

/** The most shards that a folder can be dealt to. @throws as WorkOnShard. */
int CountCards(const std::filesystem::path& folder);
/** @throws Error(kUsage) when the request has more, or asks for what the folder does not need. */
void CheckRequest(const ShardRequest& request);

/** @throws Error(kVersion) for another physics or, unless it is allowed, another build of the
program than the one that made or began what is in the folder, naming both. */
void CheckProgram(const StoreKind& kind, const ShardRequest& request);

}  // namespace graspbench
