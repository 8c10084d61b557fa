#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <string>

#include "core/base/text.h"
#include "datasets/session/session_progress.h"
#include "workbench/commands/command.h"
#include "workbench/text_table.h"

namespace graspbench {
namespace {

struct StatusOptions {
  std::filesystem::path folder;
  double stale_after = 600.0;  // [s]; the longest trials of a benchmark take a second
  bool json = false;
};

Json MakeStatusJson(const SessionProgress& progress) {
  Json shards = Json::array();
  for (const ShardProgress& one : progress.shards) {
    shards.push_back({{"shard", FormatShard(one.shard)},
                      {"trials", one.num_trials},
                      {"finished", one.num_finished},
                      {"state", NameOf(one.state)},
                      {"age_s", one.age ? Json(*one.age) : Json(nullptr)}});
  }
  return {{"trials", progress.num_trials},
          {"finished", progress.num_finished},
          {"damaged_lines", progress.num_bad_lines},
          {"shards", shards}};
}

void PrintStatus(const StatusOptions& options, const SessionProgress& progress) {
  TextTable table({"shard", "trials", "finished", "state", "last line [s] ago"});
  for (const ShardProgress& one : progress.shards) {
    table.AddRow({FormatShard(one.shard), std::to_string(one.num_trials),
                  std::to_string(one.num_finished), NameOf(one.state),
                  one.age ? FormatFixed(*one.age, 0) : "n/a"});
  }
  PrintResult(options.folder.string() + ": " + std::to_string(progress.num_finished) + " of " +
              FormatCount(progress.num_trials, "trial") + " finished\n" +
              (progress.shards.empty() ? "" : "\n" + table.Format()));
  if (progress.num_bad_lines > 0) {
    PrintMessage(FormatCount(progress.num_bad_lines, "damaged line is", "damaged lines are") +
                 " left out; see graspbench verify " + options.folder.string());
  }
}

}  // namespace

void AddStatusCommand(CLI::App& program, ExitCode&) {
  CLI::App& command =
      AddSubcommand(program, "status", "Show how far the shards of a session are, by its journals.",
                    "  graspbench status results/pilot\n"
                    "  graspbench status results/pilot --stale-after 3600 --json");
  const auto options = std::make_shared<StatusOptions>();
  command.add_option("folder", options->folder, "folder of the session")
      ->required()
      ->option_text("DIR");
  command
      .add_option("--stale-after", options->stale_after,
                  "seconds without a new line after which an unfinished shard is stale")
      ->check(CLI::PositiveNumber)
      ->option_text("S")
      ->capture_default_str();
  command.add_flag("--json", options->json, "print one JSON object");
  command.callback([options] {
    const SessionProgress progress = ReadProgress(options->folder, options->stale_after);
    if (options->json) {
      PrintJson(MakeStatusJson(progress));
    } else {
      PrintStatus(*options, progress);
    }
  });
}

}  // namespace graspbench
