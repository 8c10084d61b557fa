#include "workbench/experiments/batch_runner.h"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>

namespace graspbench {
namespace {

constexpr std::chrono::milliseconds kShowInterval(100);

class Batch {
 public:
  Batch(const std::vector<PlannedTrial>& trials, int num_workers, const std::atomic<bool>& stop)
      : trials_(trials), stop_(stop), num_running_(num_workers) {
    status_.busy.assign(num_workers, nullptr);
  }

  void Work(int worker, const MakeBatchWorker& make_worker) {
    try {
      const BatchWorker tools = make_worker(worker);
      while (const PlannedTrial* trial = Take(worker)) {
        const TrialRecord record{*trial, tools.run(*trial)};
        tools.keep(record);
        const std::lock_guard lock(mutex_);
        ++status_.num_done;
        ++status_.outcomes[record.result.outcome];
      }
    } catch (...) {
      const std::lock_guard lock(mutex_);
      if (!failure_) failure_ = std::current_exception();
    }
    const std::lock_guard lock(mutex_);
    status_.busy[worker] = nullptr;
    --num_running_;
    finished_.notify_one();
  }

  /** Shows the status until every worker is through. */
  void Watch(const ShowBatch& show) {
    std::unique_lock lock(mutex_);
    bool is_finished = false;
    while (!is_finished) {
      is_finished = finished_.wait_for(lock, kShowInterval, [this] { return num_running_ == 0; });
      const BatchStatus status = status_;
      lock.unlock();
      show(status);
      lock.lock();
    }
  }

  bool Finish() const {
    if (failure_) std::rethrow_exception(failure_);
    return status_.num_done == static_cast<int>(trials_.size());
  }

 private:
  /** The next trial for this worker; null when there is none, or the batch shall stop. */
  const PlannedTrial* Take(int worker) {
    const std::lock_guard lock(mutex_);
    const bool go_on = !stop_ && !failure_ && next_ < trials_.size();
    return status_.busy[worker] = go_on ? &trials_[next_++] : nullptr;
  }

  const std::vector<PlannedTrial>& trials_;
  const std::atomic<bool>& stop_;
  std::mutex mutex_;  // guards everything below
  std::condition_variable finished_;
  size_t next_ = 0;
  int num_running_;
  BatchStatus status_;
  std::exception_ptr failure_;
};

}  // namespace

bool RunBatch(const std::vector<PlannedTrial>& trials, int num_workers,
              const MakeBatchWorker& make_worker, const ShowBatch& show,
              const std::atomic<bool>& stop) {
  num_workers = std::max(1, std::min(num_workers, static_cast<int>(trials.size())));
  Batch batch(trials, num_workers, stop);
  std::vector<std::thread> threads;
  for (int worker = 0; worker < num_workers; ++worker) {
    threads.emplace_back([&batch, &make_worker, worker] { batch.Work(worker, make_worker); });
  }
  batch.Watch(show);
  for (std::thread& thread : threads) thread.join();
  return batch.Finish();
}

}  // namespace graspbench
