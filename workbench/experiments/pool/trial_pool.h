#pragma once
/** @file
Runs trials on several threads and gives their results in the order of asking. Each worker keeps the
simulated world of the last hand and object from one call to the next. A trial that does not end in
time is given up; its result is a numerical failure. */

#include <atomic>
#include <functional>
#include <memory>
#include <vector>

#include "core/trial/trial_result.h"
#include "workbench/experiments/pool/batch_runner.h"
#include "workbench/experiments/pool/trial_bench.h"

namespace graspbench {

/** Told of each trial as it ends, one after the other, but in a worker's thread. */
using ObserveResult = std::function<void(size_t setup, const TrialResult& result)>;

class TrialPool {
 public:
  /** @param stop  when set, Run throws Error(kInterrupted); it must outlive the pool.
  @param time_limit  of a trial [s of processor time]. */
  TrialPool(int num_workers, const std::atomic<bool>& stop, double time_limit = kTrialTimeLimit)
      : workers_(static_cast<size_t>(num_workers)), stop_(stop), time_limit_(time_limit) {}

  /** @throws Error(kInterrupted) when stopped; the first exception of a thread. */
  std::vector<TrialResult> Run(const std::vector<TrialSetup>& setups,
                               const ObserveResult& observe = nullptr);

 private:
  std::vector<std::shared_ptr<TrialBench>> workers_;  // null: made when it is needed
  const std::atomic<bool>& stop_;
  const double time_limit_;
};

}  // namespace graspbench
