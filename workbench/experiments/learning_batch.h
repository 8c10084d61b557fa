#pragma once
/** @file
Optimisations on several threads: each task, a scene or one search, runs on one thread from start to
end, so there are always as many independent trials as threads. */

#include <functional>
#include <string>
#include <vector>

#include "workbench/experiments/batch_runner.h"
#include "workbench/experiments/scene_runner.h"

namespace graspbench {

struct LearningTask {
  std::string hand, object, grasp;  ///< for the progress block
  int num_trials = 0;               ///< at most
  /** Called once, in a worker's thread. */
  std::function<void(TrialPool& pool, const ObserveLearning& observe)> run;
};

/** @param num_planned  trials of all tasks; falls when a task needs fewer than announced. */
using ShowLearning = std::function<void(const BatchStatus& status, int num_planned)>;

/** Runs the tasks in their order until all are done or `stop` is set.
@returns whether all are done.
@throws the first exception of a task, after the others have kept their current trials. */
bool RunLearningBatch(const std::vector<LearningTask>& tasks, int num_workers,
                      const ShowLearning& show, const std::atomic<bool>& stop);

}  // namespace graspbench
