#pragma once
/** @file
Runs trials on several threads and gives their results in the order of asking. Each worker keeps the
simulated world of the last hand and object from one call to the next. */

#include <atomic>
#include <vector>

#include "core/trial/trial_result.h"
#include "workbench/experiments/setup_runner.h"

namespace graspbench {

class TrialPool {
 public:
  /** @param stop  when set, Run throws Error(kInterrupted); it must outlive the pool. */
  TrialPool(int num_workers, const std::atomic<bool>& stop)
      : workers_(static_cast<size_t>(num_workers)), stop_(stop) {}

  /** @throws Error(kInterrupted) when stopped; the first exception of a thread. */
  std::vector<TrialResult> Run(const std::vector<TrialSetup>& setups);

 private:
  std::vector<SetupRunner> workers_;
  const std::atomic<bool>& stop_;
};

}  // namespace graspbench
