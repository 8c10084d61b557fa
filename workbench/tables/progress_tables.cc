#include "workbench/tables/progress_tables.h"

#include <map>
#include <utility>

#include "core/base/text/text.h"
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

namespace {

Json MakeShardsJson(const std::vector<ShardProgress>& shards, const char* unit) {
  Json json = Json::array();
  for (const ShardProgress& one : shards) {
    json.push_back({{"shard", FormatShard(one.shard)},
                    {unit, one.num_trials},
                    {"finished", one.num_finished},
                    {"state", NameOf(one.state)},
                    {"age_s", one.age ? Json(*one.age) : Json(nullptr)}});
  }
  return json;
}

}  // namespace

Json MakeStatusJson(const SessionProgress& progress) {
  Json judge = nullptr;
  if (progress.judge) {
    judge = {{"held_grasps", progress.judge->num_held},
             {"finished", progress.judge->num_judged},
             {"shards", MakeShardsJson(progress.judge->shards, "held_grasps")}};
  }
  return {{"trials", progress.num_trials},
          {"finished", progress.num_finished},
          {"damaged_lines", progress.num_bad_lines},
          {"without_sentinels", progress.unchecked},
          {"shards", MakeShardsJson(progress.shards, "trials")},
          {"judge", judge}};
}

Json MakeStatusJson(const CampaignProgress& progress) {
  return {{"scenes", progress.num_scenes},
          {"finished", progress.num_finished},
          {"without_sentinels", progress.unchecked},
          {"shards", MakeShardsJson(progress.shards, "scenes")},
          {"benchmark", progress.benchmark ? MakeStatusJson(*progress.benchmark) : Json(nullptr)},
          {"searches_begun", progress.num_searches}};
}

std::string FormatShards(const std::vector<ShardProgress>& shards, const char* unit) {
  TextTable table({"shard", unit, "finished", "state", "last line [s] ago"});
  for (const ShardProgress& one : shards) {
    table.AddRow({FormatShard(one.shard), std::to_string(one.num_trials),
                  std::to_string(one.num_finished), NameOf(one.state),
                  one.age ? FormatFixed(*one.age, 0) : "n/a"});
  }
  return shards.empty() ? "" : "\n" + table.Format();
}

}  // namespace graspbench
