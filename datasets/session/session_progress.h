#pragma once
/** @file
How far the shards of a session are, from plan and journals alone: no machine is asked, and the
records are not read beyond their checksums, so that it takes a moment for a million trials. */

#include <filesystem>
#include <optional>
#include <vector>

#include "core/base/enum_table.h"
#include "datasets/session/shard.h"

namespace graspbench {

enum class ShardState { kFinished, kRunning, kStale, kWaiting };
struct ShardStateRow {
  ShardState value;
  const char* name;
};
inline constexpr ShardStateRow kShardStates[] = {{ShardState::kFinished, "finished"},
                                                 {ShardState::kRunning, "running"},
                                                 {ShardState::kStale, "stale"},
                                                 {ShardState::kWaiting, "waiting"}};
inline const char* NameOf(ShardState state) { return RowOf(kShardStates, state).name; }

struct ShardProgress {
  Shard shard;
  int num_trials = 0;
  int num_finished = 0;
  /** Since its journals were last written [s]; none: it has none. */
  std::optional<double> age;
  ShardState state = ShardState::kWaiting;
};

struct SessionProgress {
  int num_trials = 0;
  int num_finished = 0;
  int num_bad_lines = 0;              ///< see `graspbench verify`
  std::vector<ShardProgress> shards;  ///< of every number of shards that has a journal
};

/** @param stale_after  an unfinished shard whose journals are older is stale [s].
@throws as LoadFrozen, without a look at other files; Error(kIo). */
SessionProgress ReadProgress(const std::filesystem::path& folder, double stale_after);

}  // namespace graspbench
