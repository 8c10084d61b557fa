#include "workbench/session_worker.h"

namespace graspbench {

TrialResult PlannedTrialRunner::Run(const PlannedTrial& planned) {
  const TrialSetup setup = MakeTrialSetup(config_, inputs_, planned);
  if (setup.hand != hand_ || setup.object != object_) {
    runner_ = std::make_unique<TrialRunner>(setup.hand, setup.object);
    hand_ = setup.hand;
    object_ = setup.object;
  }
  return runner_->Run(setup);
}

MakeBatchWorker MakeSessionWorkers(const SessionConfig& config, const SessionInputs& inputs,
                                   const std::filesystem::path& folder) {
  return [&config, &inputs, folder](int worker) {
    const auto runner = std::make_shared<PlannedTrialRunner>(config, inputs);
    const auto journal = std::make_shared<JournalWriter>(folder, worker);
    return BatchWorker{[runner](const PlannedTrial& planned) { return runner->Run(planned); },
                       [journal](const TrialRecord& record) { journal->Append(record); }};
  };
}

}  // namespace graspbench
