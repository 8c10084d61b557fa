#pragma once
/** @file
One machine's part of what several work on. A worker reads configuration and plan, writes journals
of its own and nothing else; which trials are its own follows from the plan
(datasets/shards/shard.h). */

#include <optional>

#include "workbench/experiments/machines/shard_work.h"

namespace graspbench {

/** Runs the sentinel trials, unless its machine has, and then what is left of the shard; see
worker_log.h. The folder holds a session, a campaign (campaign_shard.h) or an optimisation, which is
one chain and has one shard only.
@throws Error(kVersion) for another physics, build or plan, naming both; Error(kIo) when another
process works on the shard; Error(kUsage) for more shards than trials, and for what has no shards;
as LoadSession. */
ShardResult WorkOnShard(const ShardRequest& request, Observer& observer,
                        const std::atomic<bool>& stop);

/** The same for a session. @param inputs  its hands, objects and grasps; none: those that its
configuration names, as far as the shard needs them. */
ShardResult WorkOnSession(const ShardRequest& request, const std::optional<SessionInputs>& inputs,
                          Observer& observer, const std::atomic<bool>& stop);

/** The most shards that a folder can be dealt to. @throws as WorkOnShard. */
int CountCards(const std::filesystem::path& folder);
/** @throws Error(kUsage) when the request has more, or asks for what the folder does not need. */
void CheckRequest(const ShardRequest& request);

}  // namespace graspbench
