#include "workbench/experiments/machines/shard_work.h"

#include <algorithm>
#include <memory>

#include "core/base/error.h"
#include "core/base/files/files.h"
#include "workbench/experiments/machines/machine.h"
#include "workbench/experiments/pool/trial_bench.h"

namespace graspbench {
namespace fs = std::filesystem;

namespace {

/** Of sentinels, which are no part of the shard's progress. */
class TimeKeeper : public Observer {
 public:
  explicit TimeKeeper(TimeBudget& budget) : budget_(budget) {}
  void ShowStatus(const BatchStatus&, int) override { budget_.Look(); }

 private:
  TimeBudget& budget_;
};

}  // namespace

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
  const auto make_worker = [&](int) {
    const auto bench = std::make_shared<TrialBench>();
    const auto prepare = [&, bench](const PlannedTrial& planned) {
      TrialSetup setup = MakeTrialSetup(config, inputs, planned);
      TrialRunner& runner = bench->Prepare(setup);
      return [bench, &runner, setup] { return runner.Run(setup); };
    };
    return BatchWorker{prepare,
                       [&start](const TrialRecord& record) { start.sentinels.push_back(record); }};
  };
  TimeKeeper keeper(budget);
  if (!RunBatch(MakeStage(StageKind::kRun, sentinels.size()), sentinels, 1, make_worker, keeper,
                budget.stop(), trial_time_limit)) {
    return false;
  }
  log_.Append(start);
  return true;
}

}  // namespace graspbench
