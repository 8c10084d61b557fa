#include "workbench/experiments/machines/shard_work.h"

#include <algorithm>
#include <memory>

#include "core/base/error.h"
#include "core/base/files/files.h"
#include "workbench/experiments/machines/machine.h"
#include "workbench/experiments/pool/session_worker.h"

namespace graspbench {
namespace fs = std::filesystem;

void CheckProgram(const StoreKind& kind, const ShardRequest& request) {
  const std::string what = std::string("the ") + kind.name + " in \"" + request.folder.string();
  const int physics =
      IntFrom(Json::parse(ReadFile(request.folder / kind.file)).at("physics_version"));
  if (physics != kPhysicsVersion) {
    throw Error(ErrorKind::kVersion, what + "\" was planned with physics version " +
                                         std::to_string(physics) + ", this program has " +
                                         std::to_string(kPhysicsVersion) +
                                         "; work on it with the program that planned it");
  }
  const std::vector<std::string> builds = ListBuilds(request.folder);
  if (request.allow_build || builds.empty() ||
      std::find(builds.begin(), builds.end(), FindBuild()) != builds.end()) {
    return;
  }
  throw Error(ErrorKind::kVersion,
              what + "\" belongs to build " + builds.back() + " of graspbench, this is build " +
                  FindBuild() +
                  "; use that one on every machine, or --allow-build if their results are known to "
                  "be the same");
}

ShardPresence::~ShardPresence() {
  try {
    log_.Append(WorkerEnd{label_, FormatUtcNow(), num_left_});
  } catch (const std::exception&) {  // a full disk has stopped the trials already
  }
}

std::vector<PlannedTrial> ShardPresence::ListMissingSentinels(
    const std::vector<PlannedTrial>& plan) const {
  Diagnostics ignored;  // another reader reports them
  const std::vector<WorkerStart> starts = LoadWorkers(folder_, ignored).starts;
  return HasSentinels(starts, FindMachine(), plan) ? std::vector<PlannedTrial>()
                                                   : ListSentinels(plan);
}

bool ShardPresence::Begin(const std::vector<PlannedTrial>& sentinels, const SessionConfig& config,
                          const SessionInputs& inputs, TimeBudget& budget,
                          double trial_time_limit) {
  WorkerStart start{label_, FormatUtcNow(), FindMachine(), {}};
  const auto runner = std::make_shared<PlannedTrialRunner>(config, inputs);
  const auto make_worker = [&start, runner](int) {
    return BatchWorker{[runner](const PlannedTrial& planned) { return runner->Run(planned); },
                       [&start](const TrialRecord& record) { start.sentinels.push_back(record); },
                       {},
                       [runner](const PlannedTrial& planned) { runner->Prepare(planned); }};
  };
  const auto show = [&budget](const BatchStatus&) { budget.Look(); };
  if (!sentinels.empty() &&
      !RunBatch(sentinels, 1, make_worker, show, budget.stop(), trial_time_limit)) {
    return false;
  }
  log_.Append(start);
  return true;
}

}  // namespace graspbench
