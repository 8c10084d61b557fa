#pragma once
/** @file
Runs trials on several threads and gives their results in the order of asking. Each thread keeps the
simulated world of the last hand and object. */

#include <atomic>
#include <memory>
#include <vector>

#include "core/trial/trial_result.h"
#include "core/trial/trial_runner.h"
#include "core/trial/trial_setup.h"

namespace graspbench {

class TrialPool {
 public:
  /** @param stop  when set, Run throws Error(kInterrupted); it must outlive the pool. */
  TrialPool(int num_workers, const std::atomic<bool>& stop);
  ~TrialPool();

  /** @throws Error(kInterrupted) when stopped; the first exception of a thread. */
  std::vector<TrialResult> Run(const std::vector<TrialSetup>& setups);

 private:
  struct Worker;
  std::vector<std::unique_ptr<Worker>> workers_;
  const std::atomic<bool>& stop_;
};

}  // namespace graspbench
