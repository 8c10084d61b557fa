#pragma once
/** @file
Runs planned trials in the worker pool, in the plan's order, and keeps each result at once. */

#include <atomic>
#include <functional>
#include <limits>
#include <memory>
#include <vector>

#include "core/trial/trial_result.h"
#include "core/trial/trial_runner.h"
#include "core/trial/trial_setup.h"
#include "datasets/plan/session_inputs.h"
#include "datasets/session/session_store.h"
#include "objects/catalogue.h"
#include "workbench/experiments/observer.h"
#include "workbench/experiments/policies/live_policies.h"

namespace graspbench {

/** Callbacks of one worker; called from its thread only. */
struct BatchWorker {
  /** Loads what the trial needs, outside of the trial's time limit. @returns the trial itself,
  which then touches only data owned by its thread. */
  std::function<std::function<TrialResult()>(const PlannedTrial&)> prepare;
  /** Stores the record; it is on the disk when this returns. */
  std::function<void(const TrialRecord&)> keep;
  /** Handles a trial that has not ended in time, recorded as a numerical failure; empty: keeps
  it. */
  std::function<void(const TrialRecord&)> give_up = {};
};

/** Carries out a prepared trial. */
using CarryOut = std::function<TrialResult(TrialRunner& runner, const TrialSetup& setup)>;
/** Makes a worker for trials of a session, with a simulated world of its own.
@param carry_out  empty: runs the trials.
@param find_policy  empty: starts controllers.
@pre config and inputs belong together and outlive the worker. */
BatchWorker MakeTrialWorker(const SessionConfig& config, const SessionInputs& inputs,
                            std::function<void(const TrialRecord&)> keep,
                            CarryOut carry_out = nullptr, FindPolicy find_policy = nullptr);

/** Called in the worker's own thread. */
using MakeBatchWorker = std::function<BatchWorker(int worker)>;

inline constexpr double kNoTimeLimit = std::numeric_limits<double>::infinity();
/** Time after which a trial is considered endless [s of processor time]. The longest trial that the
ranges of a session allow takes some five minutes, alone on a processor. */
inline constexpr double kTrialTimeLimit = 1800.0;

/** Result of a trial that exceeded the limit: a numerical failure that says so. */
TrialResult MakeEndlessResult(double time_limit);

/** Number of consecutive trials of a worker lost with their controllers after which the batch
ends. */
inline constexpr int kMostLostInARow = 3;

/** Runs `trials`, a stage shown to the observer, until all are done or the observer requests a
stop. A trial that has begun is finished and kept. A trial whose controller was lost is not
recorded.
@param time_limit  per trial [s of processor time]: a longer trial is kept as a numerical failure or
given up; the others continue.
@throws Error(kEnvironment) at the end, when controllers were lost.
@returns, @throws as RunTasks of worker_pool.h. */
bool RunBatch(const Stage& stage, const std::vector<PlannedTrial>& trials, int num_workers,
              const MakeBatchWorker& make_worker, Observer& observer,
              double time_limit = kNoTimeLimit);

/** The simulated world of one thread that runs trials of changing hands and objects. The world of
the last hand and object is kept, because a plan lists all trials of a pair in a row. An object
without a distance field gets one here; it is released with the world. */
class TrialBench {
 public:
  /** Returns the runner of the setup's hand and object, ready for the trial. It may build a
  distance field and the world's contact points. Completes the setup's object. */
  TrialRunner& Prepare(TrialSetup& setup) {
    if (setup.hand != hand_ || setup.object != object_) {
      hand_ = setup.hand;
      object_ = setup.object;
      complete_object_.reset();  // so that only one field is in memory
      runner_.reset();
      complete_object_ = CompleteObject(object_);
      runner_ = std::make_unique<TrialRunner>(hand_, complete_object_);
    }
    setup.object = complete_object_;
    runner_->Prepare(setup.sim);
    return *runner_;
  }

 private:
  std::shared_ptr<const Hand> hand_;
  std::shared_ptr<const GraspObject> object_;  ///< as given
  std::shared_ptr<const GraspObject> complete_object_;
  std::unique_ptr<TrialRunner> runner_;
};

/** Called when a trial ends; calls do not overlap, but come from worker threads. */
using ObserveResult = std::function<void(size_t setup, const TrialResult& result)>;

/** Runs trials on several threads and returns the results in the order of the requests. Each worker
keeps the simulated world of the last hand and object between calls. A trial that does not end in
time is given up; its result is a numerical failure. */
class TrialPool {
 public:
  /** @param stop  when set, Run throws Error(kInterrupted); it must outlive the pool.
  @param time_limit  per trial [s of processor time]. */
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
