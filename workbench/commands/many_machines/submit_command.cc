#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <memory>
#include <set>
#include <string>

#include "core/base/files/files.h"
#include "datasets/session/session_progress.h"
#include "workbench/command.h"
#include "workbench/experiments/machines/run_shard.h"
#include "workbench/experiments/machines/submit_script.h"
#include "workbench/experiments/run_record.h"

namespace graspbench {
namespace {

struct SubmitOptions {
  SubmitRequest request;
  bool dry_run = false;
};

/** The number of shards that workers have begun with, which go on where they stopped. */
int FindShards(const SubmitRequest& request, int num_cards) {
  if (FindStoreKind(request.folder) == &kSessionStore) {
    std::set<int> counts = FindShardCounts(request.folder);
    counts.erase(0);
    if (counts.size() == 1) return *counts.begin();
  }
  constexpr int kShardsOfCluster = 10;
  return std::min(request.engine == "slurm" ? kShardsOfCluster : CountProcessors(), num_cards);
}

/** @param what  "judge" or "explain". */
void CheckSomethingTo(const std::string& what, const std::filesystem::path& folder) {
  if (ReadProgress(folder, 1.0).num_finished > 0) return;
  throw Error(ErrorKind::kUsage, "no trial of \"" + folder.string() +
                                     "\" has run, so there is nothing to " + what +
                                     "; submit it without --" + what + " first");
}

void Submit(const SubmitOptions& options) {
  SubmitRequest request = options.request;
  const int num_cards = CountCards(request.folder);
  request.num_rounds = FindStoreKind(request.folder) == &kCampaignStore ? 2 : 1;
  if (request.num_shards == 0) request.num_shards = FindShards(request, num_cards);
  const ShardRequest shard = {
      request.folder, {1, request.num_shards}, request.judge, request.explain};
  CheckRequest(shard);
  CheckProgram(*FindStoreKind(request.folder), shard);
  if (request.judge) CheckSomethingTo("judge", request.folder);
  if (request.explain) CheckSomethingTo("explain", request.folder);
  request.program = std::filesystem::read_symlink("/proc/self/exe");
  if (request.engine == "slurm") request.cluster = LoadClusterConfig(FindClusterFile());
  const std::string script = MakeSubmitScript(request);
  if (options.dry_run) {
    PrintResult(script);
    return;
  }
  // Here and not in the script, whose words for a full or foreign disk would be the shell's.
  MakeFolder(request.folder / "logs");
  FlushResults();
  ::execl("/bin/bash", "bash", "-c", script.c_str(), static_cast<char*>(nullptr));
  throw Error(ErrorKind::kEnvironment,
              std::string("cannot start /bin/bash: ") + std::strerror(errno));
}

}  // namespace

void AddSubmitCommand(Command& program) {
  Command& command = AddSubcommand(
      program, "submit", "Work on all shards of a session and merge them.",
      "  graspbench submit results/pilot --engine slurm --array 50 --dry-run\n  graspbench submit "
      "results/pilot --engine local\n\nPartition, account, time, memory, modules and other Slurm "
      "options are read from\n~/.config/graspbench/cluster.yaml.");
  const auto options = std::make_shared<SubmitOptions>();
  SubmitRequest& request = options->request;
  request.num_shards = 0;
  AddStoreFolder(command, request.folder, "folder made with --plan-only");
  command.AddRequired("--engine", request.engine,
                      "launcher of the workers: local, parallel or slurm", "ENGINE");
  command.AddOption("--array", request.num_shards, "number of shards", "N")
      ->Within(1, 1000000)
      ->ShowDefault("as started before; else the number of processors, slurm: 10");
  command.AddFlag("--judge", request.judge, "find breaking forces of held grasps, after a merge");
  command.AddFlag("--explain", request.explain,
                  "explain one failure of each condition, after a merge");
  command.AddFlag("--dry-run", options->dry_run, "print the script and start nothing");
  command.SetAction([options] { Submit(*options); });
}

}  // namespace graspbench
