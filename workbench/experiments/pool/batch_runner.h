#pragma once
/** @file
Runs planned trials in the pool of workers, in the plan's order, and keeps each result as soon as it
is there. */

#include <atomic>
#include <functional>
#include <limits>
#include <vector>

#include "datasets/session/session_store.h"
#include "workbench/experiments/observer.h"

namespace graspbench {

/** What one thread works with; used by that thread only. */
struct BatchWorker {
  /** Loads what the trial needs, outside of its time. @returns the trial itself, which from then on
  touches only what its thread owns. */
  std::function<std::function<TrialResult()>(const PlannedTrial&)> prepare;
  /** The record is safe when this returns. */
  std::function<void(const TrialRecord&)> keep;
  /** What to do with a trial that has not ended in time, a numerical failure; empty: keep it. */
  std::function<void(const TrialRecord&)> give_up = {};
};
/** Called in the worker's own thread. */
using MakeBatchWorker = std::function<BatchWorker(int worker)>;

inline constexpr double kNoTimeLimit = std::numeric_limits<double>::infinity();
/** After this long a trial counts as endless [s of processor time]. The longest that the ranges of a
session allow takes some five minutes alone on a processor. */
inline constexpr double kTrialTimeLimit = 1800.0;

/** Of a trial that was given up after so long: a numerical failure that says so. */
TrialResult MakeEndlessResult(double time_limit);

/** Runs `trials`, a stage that the observer sees, until all are done or `stop` is set; a trial that
has begun is finished and kept.
@param time_limit  [s of processor time]: a trial that has not ended by then is kept as a numerical
failure or given up, and the others go on.   @returns, @throws  as RunTasks of worker_pool.h. */
bool RunBatch(const Stage& stage, const std::vector<PlannedTrial>& trials, int num_workers,
              const MakeBatchWorker& make_worker, Observer& observer, const std::atomic<bool>& stop,
              double time_limit = kNoTimeLimit);

}  // namespace graspbench
