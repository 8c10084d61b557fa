#pragma once
/** @file
Progress of a session's shards, from plan and journals alone, without contacting machines. With the
indices (journal_index.h), records of indexed trials are not read unless trials are being judged.
Lines sealed by the manifest are counted without verifying their checksums. Without the indices
every other line is checked. */

#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/base/enum_table.h"
#include "datasets/journal/manifest.h"
#include "datasets/records/journal_index.h"
#include "datasets/shards/shard.h"
#include "datasets/shards/worker_log.h"

namespace graspbench {

enum class ShardState { kFinished, kRunning, kStopped, kStale, kWaiting };
struct ShardStateRow {
  ShardState value;
  const char* name;
};
inline constexpr ShardStateRow kShardStates[] = {{ShardState::kFinished, "finished"},
                                                 {ShardState::kRunning, "running"},
                                                 {ShardState::kStopped, "stopped"},
                                                 {ShardState::kStale, "stale"},
                                                 {ShardState::kWaiting, "waiting"}};
inline const char* NameOf(ShardState state) { return RowOf(kShardStates, state).name; }

struct ShardProgress {
  Shard shard;
  int num_trials = 0;
  int num_finished = 0;
  /** Time since its journals or its worker's file were last written [s]; none: there is no such
  file. */
  std::optional<double> age;
  ShardState state = ShardState::kWaiting;
};

/** Progress of judging the grasps that were held at the end of the hold. They are the "trials" of a
shard. */
struct JudgeProgress {
  int num_held = 0;
  int num_judged = 0;
  std::vector<ShardProgress> shards;  ///< for every number of shards with a judgement file
};

struct SessionProgress {
  int num_trials = 0;
  int num_finished = 0;
  int num_bad_lines = 0;              ///< among the lines read; see `verify`
  int num_foreign_lines = 0;          ///< valid lines of trials that are not in the plan
  std::vector<Damage> damages;        ///< files that are missing or have lost bytes
  std::vector<ShardProgress> shards;  ///< for every number of shards with a journal
  /** Labels of shards without sentinel trials of their machine; see worker_log.h. */
  std::set<std::string> unchecked;
  std::optional<JudgeProgress> judge;  ///< none: judging has not begun
};

/** State of the shards of one partition, by shard number, from the workers' files. */
struct Deal {
  std::map<int, double> ages;  ///< since the newest file was written [s]
  std::set<int> at_rest;       ///< shards whose worker has ended
};
/** Finds the partitions of which there are files, by number of shards.
@param subfolder  of the results. @param prefix  of a worker's label.
@param num_trials  upper bound on the number of shards. */
std::map<int, Deal> FindDeals(const std::filesystem::path& folder, const char* subfolder,
                              const std::string& prefix, const Workers& workers, int num_trials);
/** Fills in age and state of a partition's shards, whose trials are counted already. @param
stale_after  [s]. */
void CompleteShards(const Deal& deal, double stale_after, std::vector<ShardProgress>& shards);
/** Returns the time since the file was written [s]; 0 if unknown. */
double CalcAge(const std::filesystem::path& path);

/** Returns the numbers of shards of the folder's journals; 0 stands for a journal without a
shard. */
std::set<int> FindShardCounts(const std::filesystem::path& folder);

/** Reads the progress of a session. A worker that ended with trials left is stopped; one that was
killed counts as running until it is stale. If judging has begun, records are read as well, because
they contain what was held.
@param stale_after  age of its files beyond which an unfinished shard is stale [s].
@throws as LoadFrozen for the frozen configuration alone; Error(kIo). */
SessionProgress ReadProgress(const std::filesystem::path& folder, double stale_after,
                             IndexUse index_use = IndexUse::kBelieve);

}  // namespace graspbench
