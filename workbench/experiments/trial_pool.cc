#include "workbench/experiments/trial_pool.h"

#include "core/base/error.h"
#include "workbench/experiments/worker_pool.h"

namespace graspbench {

std::vector<TrialResult> TrialPool::Run(const std::vector<TrialSetup>& setups) {
  std::vector<TrialResult> results(setups.size());
  const auto make_runner = [&](int worker, const std::atomic<bool>&) -> RunTask {
    SetupRunner& runner = workers_[static_cast<size_t>(worker)];
    return [&](size_t task) { results[task] = runner.Run(setups[task]); };
  };
  const bool is_complete =
      RunTasks(setups.size(), static_cast<int>(workers_.size()), make_runner, {}, stop_);
  if (!is_complete || stop_) throw Error(ErrorKind::kInterrupted, "stopped");
  return results;
}

}  // namespace graspbench
