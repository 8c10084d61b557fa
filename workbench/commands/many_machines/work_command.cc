#include <charconv>
#include <cmath>
#include <memory>
#include <set>
#include <string>

#include "core/base/text/text.h"
#include "datasets/session/session_progress.h"
#include "workbench/command.h"
#include "workbench/experiments/machines/run_shard.h"
#include "workbench/experiments/machines/shell_quote.h"
#include "workbench/terminal/terminal_observer.h"

namespace graspbench {
namespace {

struct WorkOptions {
  ShardRequest request;
  std::string shard;
  std::string time_budget;
};

/** @returns seconds. */
double ParseTime(const std::string& text) {
  constexpr std::pair<char, double> kTimeUnits[] = {{'s', 1.0}, {'m', 60.0}, {'h', 3600.0}};
  double number = 0.0;
  const char* const end = text.data() + text.size();
  const auto read = std::from_chars(text.data(), end, number);
  for (const auto& [unit, seconds] : kTimeUnits) {
    const bool is_time = read.ec == std::errc() && number > 0.0 && std::isfinite(number);
    if (is_time && std::string_view(read.ptr) == std::string_view(&unit, 1)) {
      return number * seconds;
    }
  }
  throw Error(ErrorKind::kUsage, "--time-budget \"" + text +
                                     "\": expected a time above 0 in s, m or h, as 90s, 25m or 2h");
}

/** A worker reads no journal but its own. */
void WarnOfOtherJournals(const ShardRequest& request) {
  if (FindStoreKind(request.folder) != &kSessionStore || request.judge || request.explain) return;
  std::set<int> counts = FindShardCounts(request.folder);
  counts.erase(request.shard.count);
  if (counts.empty()) return;
  std::string others;
  for (const int count : counts) {
    others += (others.empty() ? "" : ", ") +
              (count > 0 ? "shards of " + std::to_string(count) : std::string("graspbench run"));
  }
  PrintMessage("note: trials that were run by others (" + others +
               ") are run again by a shard of " + std::to_string(request.shard.count));
}

void Work(const WorkOptions& options) {
  ShardRequest request = options.request;
  request.shard = ParseShard(options.shard);
  if (!options.time_budget.empty()) request.time_budget = ParseTime(options.time_budget);
  const std::string folder = request.folder.string(), name = folder + ", shard " + options.shard;
  WarnOfOtherJournals(request);
  TerminalObserver observer([&](const Stage& stage) { return name + ": " + DescribeTasks(stage); });
  const ShardResult result = WorkOnShard(request, observer);
  if (result.num_left > 0) {
    throw Error(ErrorKind::kInterrupted,
                name + ": stopped; " +
                    FormatCount(result.num_left, result.unit + " is", result.unit + "s are") +
                    " left; finished trials are kept. Repeat the command to continue");
  }
  PrintMessage(name + ": " + FormatCount(result.num_all, result.unit) +
               ", all finished; when all shards are finished: graspbench merge " +
               QuoteForShell(folder) + (result.goes_on ? ", then work on the shards again" : ""));
}

}  // namespace

void AddWorkCommand(Command& program) {
  Command& command =
      AddSubcommand(program, "work", "Run one shard of a session or campaign.",
                    "  graspbench work results/pilot --shard 3/7\n"
                    "  graspbench work results/pilot --shard 3/7 --time-budget 25m --judge");
  const auto options = std::make_shared<WorkOptions>();
  ShardRequest& request = options->request;
  AddStoreFolder(command, request.folder, "folder made with --plan-only");
  command.AddRequired("--shard", options->shard, "shard number and count, from 1/N to N/N", "K/N");
  command.AddFlag("--judge", request.judge,
                  "find breaking forces of the shard's held grasps; after a merge");
  command.AddFlag("--explain", request.explain,
                  "explain one failure of each condition; after a merge");
  command
      .AddOption("--time-budget", options->time_budget,
                 "stop when this time is over, finish the current trial, exit with 75", "TIME")
      ->ShowDefault("none; 90s, 25m, 2h");
  command.AddOption("--jobs", request.num_workers, "trials at a time", "N")
      ->Within(1, 1024)
      ->ShowDefault();
  AddTrialTimeoutOption(command, request.trial_time_limit);
  command.AddFlag("--allow-build", request.allow_build,
                  "accept a build of graspbench other than the one that made the plan");
  command.SetAction([options] { Work(*options); });
}

}  // namespace graspbench
