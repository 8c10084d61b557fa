#pragma once
/** @file
A plan partitioned, deterministically, over several machines. A card is a run of trials of one hand
and object, because the simulated world is built for a pair; a group of such trials is cut into
halves, quarters, .. only until no shard has more than a fifth above its share. Card i goes to shard
i modulo N. A pure function of the plan, so that every machine knows its own part without asking. */

#include <string>
#include <vector>

#include "datasets/plan/session_plan.h"

namespace graspbench {

struct Shard {
  int number = 1;  ///< one-based
  int count = 1;
};

/** Reads "3/7". @throws Error(kUsage) when it is no such pair with 1 <= number <= count. */
Shard ParseShard(const std::string& text);

/** "3/7", as ParseShard reads it. */
std::string FormatShard(const Shard& shard);

/** Whether the card of this number, from 0, is the shard's: cards go to the shards in turn. */
bool IsCardOf(size_t card, const Shard& shard);

/** "3of7": how the shard's files begin. */
std::string FormatLabel(const Shard& shard);

/** The shard that a file of this name ("3of7-0.jsonl") belongs to; count 0: none. */
Shard FindShardOfFile(const std::string& name);

/** @param group_sizes  trials of each hand and object in the plan's order.
@returns the one-based shard of every trial. @pre num_shards >= 1. */
std::vector<int> DealGroups(const std::vector<int>& group_sizes, int num_shards);

/** The shard's trials in the plan's order; none when the cards do not go round.
@throws Error(kUsage) when there are more shards than trials. */
std::vector<PlannedTrial> PartitionPlan(const std::vector<PlannedTrial>& plan, const Shard& shard);

/** Likewise with all trials of a draw, of one hand, object and number, in one shard: for plans in
which what a draw asks for next follows from its other trials.
@throws Error(kUsage) when there are more shards than draws. */
std::vector<PlannedTrial> PartitionDraws(const std::vector<PlannedTrial>& plan, const Shard& shard);
int CountDraws(const std::vector<PlannedTrial>& plan);

/** The three trials that every machine runs to be compared: the first of each hand, then the first
others of the plan. Fewer when the plan has fewer. */
std::vector<PlannedTrial> ListSentinels(const std::vector<PlannedTrial>& plan);

}  // namespace graspbench
