#include "workbench/tables/machine_tables.h"

#include <map>
#include <utility>

#include "workbench/tables/text_table.h"

namespace graspbench {

std::vector<MachineShards> ListMachines(const std::filesystem::path& folder) {
  std::map<std::string, MachineShards> by_machine;
  Diagnostics ignored;  // LoadSession has told of them
  for (const WorkerStart& start : LoadWorkers(folder, ignored).starts) {
    if (start.machine.host.empty()) continue;  // of an unknown machine
    MachineShards& entry = by_machine[DescribeMachine(start.machine)];
    entry.machine = start.machine;
    entry.shards.insert(start.shard);
  }
  std::vector<MachineShards> machines;
  for (auto& [name, entry] : by_machine) machines.push_back(std::move(entry));
  return machines;
}

std::string FormatMachines(const std::vector<MachineShards>& machines) {
  TextTable table({"machine", "processor", "C library", "build", "shards"});
  for (const auto& [machine, shards] : machines) {
    table.AddRow({machine.host, machine.processor, machine.c_library, machine.build,
                  std::to_string(shards.size())});
  }
  return machines.empty() ? "" : table.Format() + "\n";
}

size_t CountBuilds(const std::vector<MachineShards>& machines) {
  std::set<std::string> builds;
  for (const MachineShards& entry : machines) builds.insert(entry.machine.build);
  return builds.size();
}

Json MakeMachinesJson(const std::vector<MachineShards>& machines) {
  Json json = Json::array();
  for (const auto& [entry, shards] : machines) {
    Json machine = RecordToJson(entry);
    machine["shards"] = shards;
    json.push_back(machine);
  }
  return json;
}

}  // namespace graspbench
