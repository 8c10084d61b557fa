#pragma once
/** @file
Optimisations in the pool of workers: each task, a scene or one search, runs on one thread from
start to end, so there are always as many independent trials as threads. */

#include <atomic>
#include <functional>
#include <string>
#include <vector>

#include "workbench/experiments/observer.h"
#include "workbench/experiments/scene_runner.h"

namespace graspbench {

struct LearningTask {
  std::string hand, object, grasp;  ///< shown while it runs
  int num_trials = 0;               ///< at most
  /** Called once, in a worker's thread. */
  std::function<void(TrialPool& pool, const ObserveLearning& observe)> run;
};

/** Runs the tasks in their order until all are done or `stop` is set. The number of trials that the
observer is shown falls when a task needs fewer than announced.
@param trial_time_limit  see TrialPool.
@returns  whether all are done; @throws  as RunTasks of worker_pool.h. */
bool RunLearningBatch(const std::vector<LearningTask>& tasks, int num_workers, Observer& observer,
                      const std::atomic<bool>& stop, double trial_time_limit);

}  // namespace graspbench
