#include "workbench/experiments/worker_pool.h"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

#include "core/base/error.h"

namespace graspbench {
namespace {

constexpr std::chrono::milliseconds kShowInterval(100);

class Pool {
 public:
  Pool(size_t num_tasks, int num_workers, const std::atomic<bool>& stop)
      : num_tasks_(num_tasks), stop_(stop), num_running_(num_workers) {}

  void Work(int worker, const MakeTaskRunner& make_runner) {
    try {
      const RunTask run = make_runner(worker, must_stop_);
      size_t task = 0;
      while (Take(task)) {
        run(task);
        const std::lock_guard lock(mutex_);
        ++num_done_;
      }
    } catch (const Error& error) {
      if (error.kind() != ErrorKind::kInterrupted) KeepFailure();
    } catch (...) {
      KeepFailure();
    }
    const std::lock_guard lock(mutex_);
    --num_running_;
    finished_.notify_one();
  }

  /** Shows the status until every worker is through. */
  void Watch(const std::function<void()>& show) {
    std::unique_lock lock(mutex_);
    bool is_finished = false;
    while (!is_finished) {
      is_finished = finished_.wait_for(lock, kShowInterval, [this] { return num_running_ == 0; });
      if (stop_) must_stop_ = true;
      lock.unlock();
      show();
      lock.lock();
    }
  }

  bool Finish() const {
    if (failure_) std::rethrow_exception(failure_);
    return num_done_ == num_tasks_;
  }

 private:
  bool Take(size_t& task) {
    const std::lock_guard lock(mutex_);
    if (stop_ || must_stop_ || next_ == num_tasks_) return false;
    task = next_++;
    return true;
  }

  void KeepFailure() {
    const std::lock_guard lock(mutex_);
    if (!failure_) failure_ = std::current_exception();
    must_stop_ = true;
  }

  const size_t num_tasks_;
  const std::atomic<bool>& stop_;
  std::atomic<bool> must_stop_ = false;
  std::mutex mutex_;  // guards everything below
  std::condition_variable finished_;
  size_t next_ = 0, num_done_ = 0;
  int num_running_;
  std::exception_ptr failure_;
};

}  // namespace

int CalcNumWorkers(int num_wanted, size_t num_tasks) {
  return std::max(1, static_cast<int>(std::min<size_t>(static_cast<size_t>(std::max(1, num_wanted)),
                                                       num_tasks)));
}

bool RunTasks(size_t num_tasks, int num_workers, const MakeTaskRunner& make_runner,
              const std::function<void()>& show, const std::atomic<bool>& stop) {
  num_workers = CalcNumWorkers(num_workers, num_tasks);
  Pool pool(num_tasks, num_workers, stop);
  std::vector<std::thread> threads;
  for (int worker = show ? 0 : 1; worker < num_workers; ++worker) {
    threads.emplace_back([&pool, &make_runner, worker] { pool.Work(worker, make_runner); });
  }
  if (show) {
    pool.Watch(show);
  } else {
    pool.Work(0, make_runner);
  }
  for (std::thread& thread : threads) thread.join();
  return pool.Finish();
}

}  // namespace graspbench
