#pragma once
/** @file
Progress of shards, as JSON and as a table for the terminal. */

#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "core/base/text/json.h"
#include "datasets/campaign/campaign_store.h"
#include "datasets/shards/worker_log.h"

namespace graspbench {

Json MakeStatusJson(const SessionProgress& progress);
Json MakeStatusJson(const CampaignProgress& progress);

/** One row per shard; empty without shards. @param unit  what is counted: "trials", "scenes". */
std::string FormatShards(const std::vector<ShardProgress>& shards, const char* unit);

/** The machines that have worked on a session, as text and as JSON. */
struct MachineShards {
  Machine machine;
  std::set<std::string> shards;  ///< shards worked on there
};
std::vector<MachineShards> ListMachines(const std::filesystem::path& folder);
size_t CountBuilds(const std::vector<MachineShards>& machines);

/** Empty when there are none. */
std::string FormatMachines(const std::vector<MachineShards>& machines);
Json MakeMachinesJson(const std::vector<MachineShards>& machines);

}  // namespace graspbench
