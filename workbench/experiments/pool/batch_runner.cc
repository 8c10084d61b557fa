#include "workbench/experiments/pool/batch_runner.h"

#include <memory>
#include <optional>

#include "workbench/experiments/pool/worker_pool.h"

namespace graspbench {

TrialResult MakeEndlessResult(double time_limit) {
  TrialResult result;
  result.outcome = Outcome::kNumericalFailure;
  result.reason = "the trial had not ended after " + FormatJson(time_limit) + " s and was given up";
  return result;
}

bool RunBatch(const Stage& stage, const std::vector<PlannedTrial>& trials, int num_workers,
              const MakeBatchWorker& make_worker, Observer& observer, const std::atomic<bool>& stop,
              double time_limit) {
  observer.BeginStage(stage);
  if (trials.empty()) return true;
  StatusBoard board(CalcNumWorkers(num_workers, trials.size()));
  const auto make_runner = [&](int worker, const std::atomic<bool>&) -> TaskRunner {
    const auto tools = std::make_shared<BatchWorker>(make_worker(worker));
    const auto trial = std::make_shared<std::function<TrialResult()>>();
    const auto record = std::make_shared<TrialRecord>();  // of the trial that has just run
    const RunTask prepare = [&board, &trials, worker, tools, trial, record](size_t task) {
      board.SetPreparing(worker, trials[task].object);
      record->plan = trials[task];
      *trial = tools->prepare(record->plan);
      board.SetBusy(worker, record->plan);
    };
    const RunTask run = [trial, record](size_t) {
      record->result = (*trial)();
      *trial = nullptr;  // the next object's field would be a second one
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
    return {prepare, run, keep, time_limit < kNoTimeLimit ? give_up : RunTask()};
  };
  const auto show = [&] { observer.ShowStatus(board.Read(), stage.num_trials); };
  const bool is_complete =
      RunTasks(trials.size(), num_workers, make_runner, show, stop, time_limit);
  observer.EndStage();
  return is_complete;
}

}  // namespace graspbench
