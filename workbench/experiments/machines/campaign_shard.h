#pragma once
/** @file
One machine's part of a campaign. Scenes are partitioned first. When all are finished, a merge plans
the benchmark, as it needs their grasps; then the same shards take the benchmark's trials, judge
what they held, and run the searches that are compared. */

#include "workbench/experiments/machines/shard_work.h"

namespace graspbench {

/** Writes the files of its own scenes, searches and shard only. @throws as WorkOnShard. */
ShardResult WorkOnCampaign(const ShardRequest& request, Observer& observer,
                           const std::atomic<bool>& stop);

/** The most shards that it can be split into: its benchmark's trials. @throws as LoadCampaign. */
int CountCampaignCards(const std::filesystem::path& folder);

}  // namespace graspbench
