#pragma once
/** @file
Runs planned trials in the pool of workers, in the plan's order, and keeps each result as soon as it
is there. */

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

/** What a worker does with a trial that is ready. */
using CarryOut = std::function<TrialResult(TrialRunner& runner, const TrialSetup& setup)>;
/** A worker for trials of a session, with a simulated world of its own.
@param carry_out  empty: it runs them.
@param find_policy  empty: controllers are started.
@pre config and inputs belong together and outlive the worker. */
BatchWorker MakeTrialWorker(const SessionConfig& config, const SessionInputs& inputs,
                            std::function<void(const TrialRecord&)> keep,
                            CarryOut carry_out = nullptr, FindPolicy find_policy = nullptr);

/** Called in the worker's own thread. */
using MakeBatchWorker = std::function<BatchWorker(int worker)>;

inline constexpr double kNoTimeLimit = std::numeric_limits<double>::infinity();
/** After this long a trial counts as endless [s of processor time]. The longest that the ranges of
a session allow takes some five minutes alone on a processor. */
inline constexpr double kTrialTimeLimit = 1800.0;

/** Of a trial that was given up after so long: a numerical failure that says so. */
TrialResult MakeEndlessResult(double time_limit);

/** In a row of a worker, without one that ended: its controller will not do it. */
inline constexpr int kMostLostInARow = 3;

/** Runs `trials`, a stage that the observer sees, until all are done or the observer asks to stop;
a trial that has begun is finished and kept.
@param time_limit  [s of processor time]: a trial that has not ended by then is kept as a numerical
failure or given up, and the others go on. A trial whose controller was lost is left out.
@throws Error(kEnvironment) in the end, when controllers were lost.
@returns, @throws  as RunTasks of worker_pool.h. */
bool RunBatch(const Stage& stage, const std::vector<PlannedTrial>& trials, int num_workers,
              const MakeBatchWorker& make_worker, Observer& observer,
              double time_limit = kNoTimeLimit);

/** The simulated world of one thread that runs trials of changing hands and objects. That of the
last hand and object is kept: a plan has all trials of a pair in a row. An object that comes without
its distance field gets it here, and it is dropped with the world. */
class TrialBench {
 public:
  /** The runner of the setup's hand and object, with all that its trial needs: it may build a
  distance field and the world's points. Completes the setup's object. */
  TrialRunner& Prepare(TrialSetup& setup) {
    if (setup.hand != hand_ || setup.object != object_) {
      hand_ = setup.hand;
      object_ = setup.object;
      complete_object_.reset();  // two fields at a time would be one too many
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
  std::shared_ptr<const GraspObject> object_;  ///< as it came
  std::shared_ptr<const GraspObject> complete_object_;
  std::unique_ptr<TrialRunner> runner_;
};

/** Told of each trial as it ends, one after the other, but in a worker's thread. */
using ObserveResult = std::function<void(size_t setup, const TrialResult& result)>;

/** Runs trials on several threads and gives their results in the order of asking. Each worker keeps
the simulated world of the last hand and object from one call to the next. A trial that does not end
in time is given up; its result is a numerical failure. */
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
