#include "workbench/experiments/batch_runner.h"

#include <memory>

#include "workbench/experiments/worker_pool.h"

namespace graspbench {

bool RunBatch(const std::vector<PlannedTrial>& trials, int num_workers,
              const MakeBatchWorker& make_worker, const ShowBatch& show,
              const std::atomic<bool>& stop) {
  StatusBoard board(CalcNumWorkers(num_workers, trials.size()));
  const auto make_runner = [&](int worker, const std::atomic<bool>&) -> RunTask {
    const auto tools = std::make_shared<BatchWorker>(make_worker(worker));
    return [&, worker, tools](size_t task) {
      board.SetBusy(worker, trials[task]);
      const TrialRecord record{trials[task], tools->run(trials[task])};
      tools->keep(record);
      board.Count(record.result.outcome);
      board.SetBusy(worker, std::nullopt);
    };
  };
  return RunTasks(
      trials.size(), num_workers, make_runner, [&] { show(board.Read()); }, stop);
}

bool RunBatchStage(const Stage& stage, const std::vector<PlannedTrial>& trials, int num_workers,
                   const MakeBatchWorker& make_worker, Observer& observer,
                   const std::atomic<bool>& stop) {
  observer.BeginStage(stage);
  if (trials.empty()) return true;
  const auto show = [&](const BatchStatus& status) {
    observer.ShowStatus(status, stage.num_trials);
  };
  const bool is_complete = RunBatch(trials, num_workers, make_worker, show, stop);
  observer.EndStage();
  return is_complete;
}

}  // namespace graspbench
