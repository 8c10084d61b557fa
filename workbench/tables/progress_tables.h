#pragma once
/** @file
How far shards are, as JSON and as a table for the terminal. */

#include <string>
#include <vector>

#include "core/base/text/json.h"
#include "datasets/campaign/campaign_progress.h"

namespace graspbench {

Json MakeStatusJson(const SessionProgress& progress);
Json MakeStatusJson(const CampaignProgress& progress);

/** A row a shard; empty without shards. @param unit  what is counted: "trials", "scenes". */
std::string FormatShards(const std::vector<ShardProgress>& shards, const char* unit);

}  // namespace graspbench
