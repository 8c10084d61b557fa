#include "workbench/session_worker.h"

#include <memory>

#include "core/sim/trial.h"

namespace graspbench {
namespace {

/** Keeps the runner of the last hand and object: the plan has all trials of a pair in a row. */
class SessionWorker {
 public:
  SessionWorker(const SessionConfig& config, const SessionInputs& inputs,
                const std::filesystem::path& folder, int worker)
      : config_(config), inputs_(inputs), journal_(folder, worker) {}

  TrialResult Run(const PlannedTrial& planned) {
    const TrialSetup setup = MakeTrialSetup(config_, inputs_, planned);
    if (setup.hand != hand_ || setup.object != object_) {
      runner_ = std::make_unique<TrialRunner>(setup.hand, setup.object);
      hand_ = setup.hand;
      object_ = setup.object;
    }
    return runner_->Run(setup);
  }
  void Keep(const TrialRecord& record) { journal_.Append(record); }

 private:
  const SessionConfig& config_;
  const SessionInputs& inputs_;
  JournalWriter journal_;
  std::shared_ptr<const Hand> hand_;
  std::shared_ptr<const GraspObject> object_;
  std::unique_ptr<TrialRunner> runner_;
};

}  // namespace

MakeBatchWorker MakeSessionWorkers(const SessionConfig& config, const SessionInputs& inputs,
                                   const std::filesystem::path& folder) {
  return [&config, &inputs, folder](int number) {
    const auto worker = std::make_shared<SessionWorker>(config, inputs, folder, number);
    return BatchWorker{[worker](const PlannedTrial& planned) { return worker->Run(planned); },
                       [worker](const TrialRecord& record) { worker->Keep(record); }};
  };
}

}  // namespace graspbench
