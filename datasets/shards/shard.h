#pragma once
/** @file
Partitions a plan deterministically over several machines. A card is a block of consecutive trials
of one hand and object, because a simulated world is built for each such pair. Blocks are cut into
halves, quarters, .. only until no shard exceeds its share by more than a fifth. Card i belongs to
shard i modulo N. The partition is a pure function of the plan, so that every machine knows its part
without communication. */

#include <string>
#include <vector>

#include "datasets/plan/session_plan.h"

namespace graspbench {

struct Shard {
  int number = 1;  ///< one-based
  int count = 1;
};

/** Reads "3/7". @throws Error(kUsage) when it is not a pair with 1 <= number <= count. */
Shard ParseShard(const std::string& text);

/** Returns "3/7", the format of ParseShard. */
std::string FormatShard(const Shard& shard);

/** Whether the card with this index belongs to the shard. */
bool IsCardOf(size_t card, const Shard& shard);

/** Returns "3of7", the prefix of the shard's files. */
std::string FormatLabel(const Shard& shard);

/** Returns the shard of a file named like "3of7-0.jsonl"; count 0: none. */
Shard FindShardOfFile(const std::string& name);

/** Assigns trials to shards. @param group_sizes  trials of each hand and object in the plan's
order.
@returns the one-based shard of every trial. @pre num_shards >= 1. */
std::vector<int> DealGroups(const std::vector<int>& group_sizes, int num_shards);

/** Returns the shard's trials in the plan's order; empty if there are fewer cards than shards.
@throws Error(kUsage) when there are more shards than trials. */
std::vector<PlannedTrial> PartitionPlan(const std::vector<PlannedTrial>& plan, const Shard& shard);

/** As PartitionPlan(), but keeps all trials of a draw (hand, object and number) in one shard, for
plans in which the next trial of a draw depends on its other trials.
@throws Error(kUsage) when there are more shards than draws. */
std::vector<PlannedTrial> PartitionDraws(const std::vector<PlannedTrial>& plan, const Shard& shard);
int CountDraws(const std::vector<PlannedTrial>& plan);

/** Returns the three trials that every machine runs for comparison, or fewer if the plan has fewer:
the first of each hand, then the next ones of the plan. */
std::vector<PlannedTrial> ListSentinels(const std::vector<PlannedTrial>& plan);

}  // namespace graspbench
