#pragma once
/** @file
How far the shards of a session are, from plan and journals alone: no machine is asked. With the
indices no record is read whose trial one of them names (journal_index.h), unless trials are being
judged, and lines that the manifest seals are counted without a look at their checksums; without
them every line is checked. */

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
  /** Since its journals or its worker's file were last written [s]; none: it has none. */
  std::optional<double> age;
  ShardState state = ShardState::kWaiting;
};

/** Of the grasps that were held when their trial's hold ended; a shard's are its "trials". */
struct JudgeProgress {
  int num_held = 0;
  int num_judged = 0;
  std::vector<ShardProgress> shards;  ///< of every number of shards that has a file of judgements
};

struct SessionProgress {
  int num_trials = 0;
  int num_finished = 0;
  int num_bad_lines = 0;              ///< among those that were looked at; see `verify`
  int num_foreign_lines = 0;          ///< good ones of trials that the plan does not have
  std::vector<Damage> damages;        ///< files that are gone or have lost bytes
  std::vector<ShardProgress> shards;  ///< of every number of shards that has a journal
  /** Labels of shards of whose machine no sentinel trials are kept, see worker_log.h. */
  std::set<std::string> unchecked;
  std::optional<JudgeProgress> judge;  ///< none: nobody has begun to judge
};

/** What the files of workers say of the shards of one deal, by number. */
struct Deal {
  std::map<int, double> ages;  ///< since the youngest file was written [s]
  std::set<int> at_rest;       ///< whose worker has ended
};
/** @param subfolder  of the results; @param prefix  of the label of a worker;
@param num_trials  there are no more shards. @returns by number of shards. */
std::map<int, Deal> FindDeals(const std::filesystem::path& folder, const char* subfolder,
                              const std::string& prefix, const Workers& workers, int num_trials);
/** Adds age and state of the shards of a deal whose trials are counted. @param stale_after  [s]. */
void CompleteShards(const Deal& deal, double stale_after, std::vector<ShardProgress>& shards);
/** Since the file was written [s]; 0: it cannot be asked. */
double CalcAge(const std::filesystem::path& path);

/** The numbers of shards that journals of the folder are of; 0: a journal of no shard. */
std::set<int> FindShardCounts(const std::filesystem::path& folder);

/** A worker that ended with trials left has stopped. One that was killed counts as running until it
is stale. Of a judge the records are read, too, because they say what was held.
@param stale_after  an unfinished shard whose files are older is stale [s].
@throws as LoadFrozen, without a look at other files; Error(kIo). */
SessionProgress ReadProgress(const std::filesystem::path& folder, double stale_after,
                             IndexUse index_use = IndexUse::kBelieve);

}  // namespace graspbench
