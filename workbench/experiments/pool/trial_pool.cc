#include "workbench/experiments/pool/trial_pool.h"

#include <mutex>

#include "core/base/error.h"
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

}  // namespace graspbench
