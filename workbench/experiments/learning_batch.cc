#include "workbench/experiments/learning_batch.h"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>

#include "core/base/error.h"

namespace graspbench {
namespace {

constexpr std::chrono::milliseconds kShowInterval(100);

class LearningBatch {
 public:
  LearningBatch(const std::vector<LearningTask>& tasks, int num_workers,
                const std::atomic<bool>& stop)
      : tasks_(tasks), stop_(stop), num_running_(num_workers), current_(num_workers) {
    status_.busy.assign(static_cast<size_t>(num_workers), nullptr);
    for (const LearningTask& task : tasks) num_planned_ += task.num_trials;
  }

  void Work(size_t worker) {
    try {
      TrialPool pool(1, must_stop_);
      while (const LearningTask* task = Take(worker)) {
        int num_trials = 0;
        task->run(pool, [&](const LearningRequest& request, const LearningTrial& trial) {
          ++num_trials;
          Note(worker, *task, request, trial);
        });
        const std::lock_guard lock(mutex_);
        num_planned_ -= task->num_trials - num_trials;
        ++num_finished_;
      }
    } catch (const Error& error) {
      if (error.kind() != ErrorKind::kInterrupted) KeepFailure();
    } catch (...) {
      KeepFailure();
    }
    const std::lock_guard lock(mutex_);
    status_.busy[worker] = nullptr;
    --num_running_;
    finished_.notify_one();
  }

  /** Shows the status until every worker is through. */
  void Watch(const ShowLearning& show) {
    std::unique_lock lock(mutex_);
    bool is_finished = false;
    while (!is_finished) {
      is_finished = finished_.wait_for(lock, kShowInterval, [this] { return num_running_ == 0; });
      if (stop_) must_stop_ = true;
      const BatchStatus status = status_;
      // The names that the status points at are changed under the lock only.
      show(status, num_planned_);
    }
  }

  bool Finish() const {
    if (failure_) std::rethrow_exception(failure_);
    return num_finished_ == tasks_.size();
  }

 private:
  const LearningTask* Take(size_t worker) {
    const std::lock_guard lock(mutex_);
    const bool go_on = !must_stop_ && next_ < tasks_.size();
    status_.busy[worker] = nullptr;
    return go_on ? &tasks_[next_++] : nullptr;
  }

  void Note(size_t worker, const LearningTask& task, const LearningRequest& request,
            const LearningTrial& trial) {
    const std::lock_guard lock(mutex_);
    ++status_.num_done;
    ++status_.outcomes[trial.outcome];
    current_[worker] = {"", task.hand, task.object, task.grasp + "  " + request.stage,
                        request.individual.number};
    status_.busy[worker] = &current_[worker];
  }

  void KeepFailure() {
    const std::lock_guard lock(mutex_);
    if (!failure_) failure_ = std::current_exception();
    must_stop_ = true;
  }

  const std::vector<LearningTask>& tasks_;
  const std::atomic<bool>& stop_;
  std::atomic<bool> must_stop_ = false;
  std::mutex mutex_;  // guards everything below
  std::condition_variable finished_;
  size_t next_ = 0, num_finished_ = 0;
  int num_running_;
  int num_planned_ = 0;
  BatchStatus status_;
  std::vector<PlannedTrial> current_;  // what each worker is doing
  std::exception_ptr failure_;
};

}  // namespace

bool RunLearningBatch(const std::vector<LearningTask>& tasks, int num_workers,
                      const ShowLearning& show, const std::atomic<bool>& stop) {
  num_workers = std::max(1, std::min(num_workers, static_cast<int>(tasks.size())));
  LearningBatch batch(tasks, num_workers, stop);
  std::vector<std::thread> threads;
  for (int worker = 0; worker < num_workers; ++worker) {
    threads.emplace_back([&batch, worker] { batch.Work(static_cast<size_t>(worker)); });
  }
  batch.Watch(show);
  for (std::thread& thread : threads) thread.join();
  return batch.Finish();
}

}  // namespace graspbench
