#pragma once
/** @file
The machines that have worked on a session, as text and as JSON. */

#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "datasets/shards/worker_log.h"

namespace graspbench {

struct MachineShards {
  Machine machine;
  std::set<std::string> shards;  ///< that were worked on there
};
std::vector<MachineShards> ListMachines(const std::filesystem::path& folder);
size_t CountBuilds(const std::vector<MachineShards>& machines);

/** Empty when there are none. */
std::string FormatMachines(const std::vector<MachineShards>& machines);
Json MakeMachinesJson(const std::vector<MachineShards>& machines);

}  // namespace graspbench
