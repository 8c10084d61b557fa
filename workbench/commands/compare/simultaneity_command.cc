#include <CLI/CLI.hpp>
#include <memory>
#include <string>

#include "workbench/commands/command.h"
#include "workbench/experiments/delay_sweep.h"
#include "workbench/experiments/interrupt.h"
#include "workbench/tables/simultaneity_tables.h"
#include "workbench/terminal/terminal_observer.h"

namespace graspbench {
namespace {

struct SimultaneityOptions {
  std::string folder;
  bool delays = false;
  DelaySweepRequest request;
  int num_workers = 1;
  bool json = false;
};

template <class Rows>
Json ListRows(const Rows& rows) {
  Json list = Json::array();
  for (const auto& row : rows) list.push_back(ToJson(row));
  return list;
}

std::vector<DoseResponse> Sweep(SimultaneityOptions& options) {
  options.request.folder = options.folder;
  const std::atomic<bool>& stop = CatchInterrupts();
  TerminalObserver observer(
      [](const Stage& stage) { return stage.variant + ": " + DescribeTasks(stage); }, stop);
  return SummariseDelays(SweepDelays(options.request, options.num_workers, observer, stop));
}

void Run(SimultaneityOptions& options) {
  if (options.delays) {
    const std::vector<DoseResponse> rows = Sweep(options);
    if (options.json) return PrintJson({{"delays", ListRows(rows)}});
    return PrintResult(FormatDoseResponses(rows));
  }
  const Session session = LoadSession(options.folder);
  if (!session.findings.entries().empty()) PrintMessage(session.findings.Format());
  const std::vector<SimultaneityRelation> relations = SummariseSimultaneity(session);
  if (options.json) return PrintJson({{"relations", ListRows(relations)}});
  PrintResult(FormatRelations(relations));
}

}  // namespace

void AddSimultaneityCommand(CLI::App& program, ExitCode&) {
  CLI::App& command = AddSubcommand(
      program, "simultaneity",
      "Ask a session's trials whether it matters that the digits touch at once.",
      "  graspbench simultaneity results/pilot            inside cells, as the trials came\n"
      "  graspbench simultaneity results/pilot --delay    the same trials, one digit delayed");
  const auto options = std::make_shared<SimultaneityOptions>();
  command.add_option("folder", options->folder, "folder of the session")
      ->required()
      ->option_text("DIR");
  CLI::Option* delay = command.add_flag(
      "--delay", options->delays,
      "run trials again with the digit that touched last, or first, 50 to 300 ms later, the object "
      "as it was, light, slippery and off-centre");
  command
      .add_option("--trials", options->request.trials_per_cell,
                  "trials of each hand, object, grasp to delay")
      ->needs(delay)
      ->check(CLI::Range(1, 100000))
      ->option_text("N")
      ->capture_default_str();
  command
      .add_flag("--judge", options->request.with_judge,
                "find breaking forces of the delayed, too; some five times as long")
      ->needs(delay);
  AddJobsOption(command, options->num_workers);
  command.add_flag("--json", options->json, "print one JSON object");
  command.callback([options] { Run(*options); });
}

}  // namespace graspbench
