#include "workbench/experiments/pool/learning_batch.h"

#include <algorithm>
#include <memory>

#include "workbench/experiments/pool/worker_pool.h"

namespace graspbench {

bool RunLearningBatch(const std::vector<LearningTask>& tasks, int num_workers, Observer& observer,
                      const std::atomic<bool>& stop, double trial_time_limit) {
  StatusBoard board(CalcNumWorkers(num_workers, tasks.size()));
  std::atomic<int> num_planned = 0;
  for (const LearningTask& task : tasks) num_planned += task.num_trials;
  const auto make_runner = [&](int worker, const std::atomic<bool>& must_stop) -> RunTask {
    const auto pool = std::make_shared<TrialPool>(1, must_stop, trial_time_limit);
    return [&, worker, pool](size_t i) {
      const LearningTask& task = tasks[i];
      int num_trials = 0;
      task.run(*pool, [&](const LearningRequest& request, const LearningTrial& trial) {
        if (++num_trials > task.num_trials) ++num_planned;  // which was an estimate
        board.Count(trial.outcome);
        board.SetBusy(worker, PlannedTrial{"", task.hand, task.object,
                                           task.grasp + "  " + NameOf(request.stage),
                                           request.individual.number});
      });
      num_planned -= std::max(0, task.num_trials - num_trials);
      board.SetBusy(worker, std::nullopt);
    };
  };
  return RunTasks(
      tasks.size(), num_workers, make_runner,
      [&] { observer.ShowStatus(board.Read(), num_planned); }, stop);
}

}  // namespace graspbench
