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

struct MachinesOfSession {
  std::map<std::string, std::pair<Machine, std::set<std::string>>> shards;  ///< by what it is
  std::set<std::string> builds;
};

MachinesOfSession ListMachines(const fs::path& folder) {
  MachinesOfSession machines;
  Diagnostics ignored;  // LoadSession has told of them
  for (const WorkerStart& start : LoadWorkers(folder, ignored)) {
    auto& [machine, shards] = machines.shards[DescribeMachine(start.machine)];
    machine = start.machine;
    shards.insert(start.shard);
    machines.builds.insert(start.machine.build);
  }
  return machines;
}

std::string FormatMachines(const MachinesOfSession& machines) {
  TextTable table({"machine", "processor", "C library", "build", "shards"});
  for (const auto& [name, entry] : machines.shards) {
    const auto& [machine, shards] = entry;
    table.AddRow({machine.host, machine.processor, machine.c_library, machine.build,
                  std::to_string(shards.size())});
  }
  return machines.shards.empty() ? "" : table.Format() + "\n";
}

Json MakeJson(const SessionSummary& summary, const MachinesOfSession& machines,
              const Session& session, const MergeOptions& options, const fs::path& report) {
  Json json = MakeSummaryJson(summary, options.folder, report);
  json["left"] = session.plan.size() - session.records.size();
  json["machines"] = Json::array();
  for (const auto& [name, entry] : machines.shards) {
    Json machine = RecordToJson(entry.first);
    machine["shards"] = entry.second;
    json["machines"].push_back(machine);
  }
  json["differences"] = session.machine_differences;
  return json;
}

ExitCode Merge(const MergeOptions& options) {
  const int num_new = MergeSessions(options.folder, options.others);
  const Session session = LoadSession(options.folder);  // finds damage before it is sealed
  SealStore(kSessionStore, options.folder);
  ExportSession(options.folder, session);
  const fs::path report = WriteSessionReport(options.folder, session);
  const MachinesOfSession machines = ListMachines(options.folder);
  const SessionSummary summary = SummariseSession(session);
  if (options.json) {
    PrintJson(MakeJson(summary, machines, session, options, report));
  } else {
    PrintResult(FormatMachines(machines) + FormatSummaryTable(summary) + "\nreport   " +
                report.string() + "\ndata     " +
                (options.folder / "export" / "trials.csv").string() + "\n");
  }
  if (num_new > 0) PrintMessage(FormatCount(num_new, "trial") + " came from other folders");
  if (machines.builds.size() > 1) {
    PrintMessage("note: " + std::to_string(machines.builds.size()) +
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
