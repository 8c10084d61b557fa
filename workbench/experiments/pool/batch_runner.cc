#include "workbench/experiments/pool/batch_runner.h"

#include <memory>

#include "workbench/experiments/pool/worker_pool.h"

namespace graspbench {

TrialResult MakeEndlessResult(double time_limit) {
  TrialResult result;
  result.outcome = Outcome::kNumericalFailure;
  result.reason = "the trial had not ended after " + FormatJson(time_limit) + " s and was given up";
  return result;
}

bool RunBatch(const std::vector<PlannedTrial>& trials, int num_workers,
              const MakeBatchWorker& make_worker, const ShowBatch& show,
              const std::atomic<bool>& stop, double time_limit) {
  StatusBoard board(CalcNumWorkers(num_workers, trials.size()));
  const auto make_runner = [&](int worker, const std::atomic<bool>&) -> TaskRunner {
    const auto tools = std::make_shared<BatchWorker>(make_worker(worker));
    const auto record = std::make_shared<TrialRecord>();  // of the trial that has just run
    const RunTask prepare = [&board, &trials, worker, tools](size_t task) {
      board.SetPreparing(worker, trials[task].object);
      tools->prepare(trials[task]);
    };
    const RunTask run = [&board, &trials, worker, tools, record](size_t task) {
      board.SetBusy(worker, trials[task]);
      record->plan = trials[task];
      record->result = tools->run(record->plan);
    };
    const RunTask keep = [&board, worker, tools, record](size_t) {
      tools->keep(*record);
      board.Count(record->result.outcome);
      board.SetBusy(worker, std::nullopt);
    };
    const RunTask give_up = [&board, &trials, worker, tools, time_limit](size_t task) {
      const TrialRecord endless = {trials[task], MakeEndlessResult(time_limit)};
      (tools->give_up ? tools->give_up : tools->keep)(endless);
      board.Count(endless.result.outcome);
      board.SetBusy(worker, std::nullopt);
    };
    return {tools->prepare ? prepare : RunTask(), run, keep,
            time_limit < kNoTimeLimit ? give_up : RunTask()};
  };
  return RunTasks(
      trials.size(), num_workers, make_runner, [&] { show(board.Read()); }, stop, time_limit);
}

bool RunBatchStage(const Stage& stage, const std::vector<PlannedTrial>& trials, int num_workers,
                   const MakeBatchWorker& make_worker, Observer& observer,
                   const std::atomic<bool>& stop, double time_limit) {
  observer.BeginStage(stage);
  if (trials.empty()) return true;
  const auto show = [&](const BatchStatus& status) {
    observer.ShowStatus(status, stage.num_trials);
  };
  const bool is_complete = RunBatch(trials, num_workers, make_worker, show, stop, time_limit);
  observer.EndStage();
  return is_complete;
}

}  // namespace graspbench
