#include "workbench/experiments/pool/batch_runner.h"

#include <memory>
#include <mutex>
#include <optional>

#include "core/base/error.h"
#include "core/base/text/text.h"
#include "workbench/experiments/pool/worker_pool.h"

namespace graspbench {

namespace {

/** All that a trial which is given up may still use. */
struct RunningTrial {
  std::shared_ptr<TrialBench> bench;
  TrialSetup setup;
  TrialRunner* runner = nullptr;  // the bench's
  TrialResult result;
};

/** Trials of which nothing is known, because their controllers were lost; noted by any worker. */
class LostTrials {
 public:
  void Note(const PlannedTrial& planned, const std::string& reason) {
    const std::lock_guard lock(mutex_);
    if (num_++ == 0) first_ = DescribeTrial(planned) + ": " + reason;
  }
  int num() const {
    const std::lock_guard lock(mutex_);
    return num_;
  }
  std::string Describe() const {
    const std::lock_guard lock(mutex_);
    return "the controller was lost in " + FormatCount(num_, "trial") +
           ", which stay unfinished and count in no rate; first in " + first_;
  }

 private:
  mutable std::mutex mutex_;
  int num_ = 0;
  std::string first_;
};

}  // namespace

std::vector<TrialResult> TrialPool::Run(const std::vector<TrialSetup>& setups,
                                        const ObserveResult& observe) {
  std::vector<TrialResult> results(setups.size());
  std::mutex observing;
  const auto tell = [&](size_t task) {
    if (!observe) return;
    const std::lock_guard<std::mutex> lock(observing);
    observe(task, results[task]);
  };
  std::atomic<bool> is_one_given_up{false};
  const auto make_runner = [&](int worker, const std::atomic<bool>&) -> TaskRunner {
    const auto trial = std::make_shared<RunningTrial>();
    if (const auto number = static_cast<size_t>(worker); number < workers_.size()) {
      if (!workers_[number]) workers_[number] = std::make_shared<TrialBench>();
      trial->bench = workers_[number];
    } else {  // in the place of one that was given up
      trial->bench = std::make_shared<TrialBench>();
    }
    const RunTask prepare = [&setups, trial](size_t task) {
      trial->setup = setups[task];
      trial->runner = &trial->bench->Prepare(trial->setup);
    };
    const RunTask run = [trial](size_t) { trial->result = trial->runner->Run(trial->setup); };
    const RunTask keep = [&results, &tell, trial](size_t task) {
      results[task] = trial->result;
      tell(task);
    };
    const RunTask give_up = [&, this](size_t task) {
      results[task] = MakeEndlessResult(time_limit_);
      is_one_given_up = true;
      tell(task);
    };
    return {prepare, run, keep, give_up};
  };
  const bool is_complete = RunTasks(
      setups.size(), static_cast<int>(workers_.size()), make_runner, [] {}, stop_, time_limit_);
  if (is_one_given_up) workers_.assign(workers_.size(), nullptr);  // its thread has one of them
  if (!is_complete || stop_) throw Error(ErrorKind::kInterrupted, "stopped");
  return results;
}

TrialResult MakeEndlessResult(double time_limit) {
  TrialResult result;
  result.outcome = Outcome::kNumericalFailure;
  result.reason = "the trial did not end within " + FormatJson(time_limit) + " s and was abandoned";
  return result;
}

BatchWorker MakeTrialWorker(const SessionConfig& config, const SessionInputs& inputs,
                            std::function<void(const TrialRecord&)> keep, CarryOut carry_out,
                            FindPolicy find_policy) {
  const auto bench = std::make_shared<TrialBench>();
  if (!find_policy) find_policy = MakeLivePolicies();
  const auto prepare = [&config, &inputs, carry_out, find_policy,
                        bench](const PlannedTrial& planned) -> std::function<TrialResult()> {
    TrialSetup setup = MakeTrialSetup(config, inputs, planned);
    setup.controller = find_policy(setup, planned);
    TrialRunner& runner = bench->Prepare(setup);
    return [bench, &runner, setup, carry_out] {
      return carry_out ? carry_out(runner, setup) : runner.Run(setup);
    };
  };
  return {prepare, std::move(keep)};
}

bool RunBatch(const Stage& stage, const std::vector<PlannedTrial>& trials, int num_workers,
              const MakeBatchWorker& make_worker, Observer& observer, double time_limit) {
  observer.BeginStage(stage);
  if (trials.empty()) return true;
  StatusBoard board(CalcNumWorkers(num_workers, trials.size()));
  const auto lost = std::make_shared<LostTrials>();  // also of a thread that is given up
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
    const auto num_lost = std::make_shared<int>(0);  // in a row
    const RunTask run = [lost, trial, record, num_lost](size_t) {
      try {
        record->result = (*trial)();
        *num_lost = 0;
      } catch (const PolicyLost& loss) {
        record->result = {};
        lost->Note(record->plan, loss.what());
        if (++*num_lost == kMostLostInARow) throw Error(ErrorKind::kEnvironment, lost->Describe());
      }
      *trial = nullptr;  // the next object's field would be a second one
    };
    const RunTask keep = [&board, worker, tools, record](size_t) {
      if (record->result.outcome != Outcome::kNotRun) {
        tools->keep(*record);
        board.Count(record->result.outcome);
      }
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
      RunTasks(trials.size(), num_workers, make_runner, show, observer.stop(), time_limit);
  if (lost->num() > 0) throw Error(ErrorKind::kEnvironment, lost->Describe());
  observer.EndStage();
  return is_complete;
}

}  // namespace graspbench
