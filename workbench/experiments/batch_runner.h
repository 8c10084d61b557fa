#pragma once
/** @file
Runs planned trials on several threads, in the plan's order, and keeps each result as soon as it is
there. A trial runs on one thread from start to end, and nothing passes from one trial to the next,
so the results do not depend on the number of workers. */

#include <atomic>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "datasets/session/session_plan.h"
#include "datasets/session/session_store.h"

namespace graspbench {

/** What one thread works with; used by that thread only. */
struct BatchWorker {
  std::function<TrialResult(const PlannedTrial&)> run;
  /** The record is safe when this returns. */
  std::function<void(const TrialRecord&)> keep;
};
/** Called in the worker's own thread. */
using MakeBatchWorker = std::function<BatchWorker(int worker)>;

struct BatchStatus {
  int num_done = 0;                       ///< kept in this batch
  std::map<Outcome, int> outcomes;        ///< of those
  std::vector<const PlannedTrial*> busy;  ///< each worker's current trial; null: idle
};
/** Called about ten times a second in the caller's thread, and once at the end. */
using ShowBatch = std::function<void(const BatchStatus&)>;

/** Runs `trials` until all are done or `stop` is set; a trial that has begun is finished and kept.
@param num_workers  at least 1; no more threads than trials are started.
@returns whether all trials are done.
@throws the first exception of a worker, after the others have kept their current trials. */
bool RunBatch(const std::vector<PlannedTrial>& trials, int num_workers,
              const MakeBatchWorker& make_worker, const ShowBatch& show,
              const std::atomic<bool>& stop);

}  // namespace graspbench
