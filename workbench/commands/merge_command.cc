#include <CLI/CLI.hpp>
#include <filesystem>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "core/base/text.h"
#include "datasets/analysis/session_summary.h"
#include "datasets/session/merge_sessions.h"
#include "datasets/session/worker_log.h"
#include "reports/session_report.h"
#include "workbench/commands/command.h"
#include "workbench/summary_table.h"
#include "workbench/text_table.h"

namespace graspbench {
namespace fs = std::filesystem;

namespace {

struct MergeOptions {
  fs::path folder;
  std::vector<fs::path> others;
  bool json = false;
};

struct MachineShards {
  Machine machine;
  std::set<std::string> shards;  ///< that were worked on there
};

std::vector<MachineShards> ListMachines(const fs::path& folder) {
  std::map<std::string, MachineShards> by_machine;
  Diagnostics ignored;  // LoadSession has told of them
  for (const WorkerStart& start : LoadWorkers(folder, ignored)) {
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

Json MakeJson(const SessionSummary& summary, const std::vector<MachineShards>& machines,
              const Session& session, const MergeOptions& options, const fs::path& report) {
  Json json = MakeSummaryJson(summary, options.folder, report);
  json["left"] = session.plan.size() - session.records.size();
  json["machines"] = Json::array();
  for (const auto& [entry, shards] : machines) {
    Json machine = RecordToJson(entry);
    machine["shards"] = shards;
    json["machines"].push_back(machine);
  }
  json["differences"] = session.machine_differences;
  return json;
}

ExitCode Merge(const MergeOptions& options) {
  const int num_new = MergeSessions(options.folder, options.others);
  // Damage is found before it is sealed.
  const Session session = LoadSession(options.folder, OnDamage::kRefuse, RecordParts::kBrief);
  SealStore(kSessionStore, options.folder);
  ExportSession(options.folder, session);
  const fs::path report = WriteSessionReport(options.folder, session);
  const std::vector<MachineShards> machines = ListMachines(options.folder);
  const SessionSummary summary = SummariseSession(session);
  if (options.json) {
    PrintJson(MakeJson(summary, machines, session, options, report));
  } else {
    PrintResult(FormatMachines(machines) + FormatSummaryTable(summary) + "\nreport   " +
                report.string() + "\ndata     " +
                (options.folder / "export" / "trials.csv").string() + "\n");
  }
  if (num_new > 0) PrintMessage(FormatCount(num_new, "trial") + " came from other folders");
  const size_t num_builds = CountBuilds(machines);
  if (num_builds > 1) {
    PrintMessage("note: " + std::to_string(num_builds) +
                 " builds of graspbench have worked on this session");
  }
  for (const std::string& difference : session.machine_differences) {
    PrintMessage("warning: " + difference);
  }
  const auto num_left = static_cast<int64_t>(session.plan.size() - session.records.size());
  if (num_left > 0) {
    throw Error(ErrorKind::kInterrupted,
                FormatCount(num_left, "trial is", "trials are") +
                    " left; what is there is merged and reported. Work on the shards again, then "
                    "merge again: graspbench status " +
                    options.folder.string());
  }
  return summary.total.CountOf(Outcome::kNumericalFailure) > 0 ? kExitNumericalFailures : kExitOk;
}

}  // namespace

void AddMergeCommand(CLI::App& program, ExitCode& exit_code) {
  CLI::App& command = AddSubcommand(
      program, "merge", "Put the shards of a session together and write its report.",
      "  graspbench merge results/pilot                 after graspbench work, on one disk\n"
      "  graspbench merge results/pilot node1/pilot node2/pilot");
  const auto options = std::make_shared<MergeOptions>();
  command.add_option("folder", options->folder, "folder of the session")
      ->required()
      ->option_text("DIR");
  command.add_option("others", options->others, "folders of the same session on other disks")
      ->option_text("OTHER..");
  command.add_flag("--json", options->json, "print summary and machines as one JSON object");
  command.callback([options, &exit_code] { exit_code = Merge(*options); });
}

}  // namespace graspbench
