#include <CLI/CLI.hpp>
#include <limits>
#include <map>
#include <memory>
#include <string>

#include "core/base/text.h"
#include "workbench/commands/command.h"
#include "workbench/experiments/interrupt.h"
#include "workbench/experiments/run_shard.h"
#include "workbench/terminal_observer.h"

namespace graspbench {
namespace {

struct WorkOptions {
  ShardRequest request;
  std::string folder;
  std::string shard;
};

void Work(const WorkOptions& options) {
  ShardRequest request = options.request;
  request.folder = options.folder;
  request.shard = ParseShard(options.shard);
  const std::string name = options.folder + ", shard " + options.shard;
  const std::atomic<bool>& stop = CatchInterrupts();
  TerminalObserver observer(
      [&](const Stage& stage) {
        return name + ": " + FormatCount(stage.num_left, "trial") + " to " + stage.name;
      },
      stop);
  const ShardResult result = WorkOnShard(request, observer, stop);
  if (result.num_left > 0) {
    throw Error(ErrorKind::kInterrupted,
                name + ": stopped; " + FormatCount(result.num_left, "trial is", "trials are") +
                    " left and the finished ones are kept. The same command goes on");
  }
  PrintMessage(name + ": " + FormatCount(result.num_trials, "trial") +
               ", all finished; when every shard is: graspbench merge " + options.folder);
}

}  // namespace

void AddWorkCommand(CLI::App& program, ExitCode&) {
  CLI::App& command = AddSubcommand(
      program, "work", "Run one machine's part of a session that several machines work on.",
      "  graspbench work results/pilot --shard 3/7\n"
      "  graspbench work results/pilot --shard 3/7 --time-budget 25m --judge");
  const auto options = std::make_shared<WorkOptions>();
  ShardRequest& request = options->request;
  command.add_option("folder", options->folder, "folder made by run --plan-only")
      ->required()
      ->option_text("DIR");
  command.add_option("--shard", options->shard, "which part of how many, from 1/N to N/N")
      ->required()
      ->option_text("K/N");
  command.add_flag("--judge", request.judge, "break what the shard's trials held; after a merge");
  command
      .add_option("--time-budget", request.time_budget,
                  "stop before this time is over, finish the current trial, exit with 75")
      ->transform(CLI::AsNumberWithUnit(
          std::map<std::string, double>{{"s", 1.0}, {"m", 60.0}, {"h", 3600.0}}))
      ->check(CLI::PositiveNumber)
      ->option_text("TIME")
      ->default_str("none; units s, m, h");
  command.add_option("--jobs", request.num_workers, "trials at a time")
      ->check(CLI::Range(1, 1024))
      ->option_text("N")
      ->capture_default_str();
  AddTrialTimeoutOption(command, request.trial_time_limit);
  command.add_flag("--allow-build", request.allow_build,
                   "work with another build of graspbench than the one that made the plan");
  command.callback([options] { Work(*options); });
}

}  // namespace graspbench
