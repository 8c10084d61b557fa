#include "workbench/experiments/pool/worker_pool.h"

#include <pthread.h>
#include <time.h>

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <memory>
#include <mutex>
#include <optional>
#include <system_error>
#include <thread>
#include <vector>

#include "core/base/error.h"

namespace graspbench {
namespace {

constexpr std::chrono::milliseconds kShowInterval(100);

std::atomic<int> num_abandoned{0};

/** Processor time of one thread, which any other may ask for: what is given up must not depend on
how busy the machine is or whether the program was suspended. */
class ThreadClock {
 public:
  /** The calling thread's. */
  ThreadClock() { ::pthread_getcpuclockid(::pthread_self(), &id_); }
  /** [s]; 0 when the thread has ended. */
  double Now() const {
    timespec time = {};
    if (::clock_gettime(id_, &time) != 0) return 0.0;
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
  }

 private:
  clockid_t id_ = CLOCK_THREAD_CPUTIME_ID;
};

/** Shared with its threads, because one that was given up may outlive the call that started it. */
class Pool : public std::enable_shared_from_this<Pool> {
 public:
  Pool(size_t num_tasks, const std::atomic<bool>& stop, double time_limit)
      : num_tasks_(num_tasks), stop_(stop), time_limit_(time_limit) {}

  /** In a thread of its own. @param given_up  a task to give up before anything else.
  @throws Error(kEnvironment) when the machine gives no thread; the pool is as it was. */
  void Start(const MakeTaskRunner& make_runner, std::optional<size_t> given_up = std::nullopt) {
    const std::lock_guard lock(mutex_);
    ++num_running_;
    seats_.push_back(std::make_unique<Seat>());
    Seat& seat = *seats_.back();
    try {
      seat.thread = std::thread([pool = shared_from_this(), &make_runner, &seat, given_up,
                                 worker = static_cast<int>(seats_.size()) - 1] {
        pool->Work(seat, worker, make_runner, given_up);
      });
    } catch (const std::system_error& fault) {
      seats_.pop_back();
      --num_running_;
      throw Error(ErrorKind::kEnvironment,
                  std::string("the machine or a limit (ulimit -u, -v) allows no further thread (") +
                      fault.what() + "); use fewer workers (--jobs 1) or raise the limit");
    }
  }

  /** In the caller's thread. */
  void WorkHere(const MakeTaskRunner& make_runner) {
    Seat* seat = nullptr;
    int worker = 0;
    {
      const std::lock_guard lock(mutex_);
      ++num_running_;
      worker = static_cast<int>(seats_.size());
      seats_.push_back(std::make_unique<Seat>());
      seat = seats_.back().get();
    }
    Work(*seat, worker, make_runner, std::nullopt);
  }

  /** Shows the status until every worker is through or given up. */
  void Watch(const MakeTaskRunner& make_runner, const std::function<void()>& show) {
    std::unique_lock lock(mutex_);
    bool is_finished = false;
    while (!is_finished) {
      is_finished = finished_.wait_for(lock, kShowInterval, [this] { return num_running_ == 0; });
      if (stop_) must_stop_ = true;
      const std::vector<size_t> overdue = AbandonOverdue();
      lock.unlock();
      for (const size_t task : overdue) Replace(make_runner, task);
      show();
      lock.lock();
      is_finished = is_finished && overdue.empty();
    }
  }

  /** Workers end with the task that they have. */
  void Stop() { must_stop_ = true; }

  /** Waits for the threads. @returns whether all tasks are done. */
  bool Finish() {
    for (const auto& seat : seats_) {
      if (!seat->thread.joinable()) continue;
      if (seat->is_abandoned) {
        seat->thread.detach();
      } else {
        seat->thread.join();
      }
    }
    if (failure_) std::rethrow_exception(failure_);
    return num_done_ == num_tasks_;
  }

 private:
  struct Seat {
    std::thread thread;
    std::optional<size_t> task;  ///< that it works on and that may be given up
    ThreadClock clock;           ///< of the thread that began the task
    double start = 0.0;          ///< of that task, on this clock [s]
    bool is_abandoned = false;
  };

  void Work(Seat& seat, int worker, const MakeTaskRunner& make_runner,
            std::optional<size_t> given_up) {
    try {
      const TaskRunner runner = make_runner(worker, must_stop_);
      if (given_up) {
        runner.give_up(*given_up);
        CountDone();
      }
      size_t task = 0;
      while (Take(task)) {
        if (runner.prepare) runner.prepare(task);
        if (runner.give_up) SetTask(seat, task);
        runner.run(task);
        // The watcher looks now and then; a task that has ended unseen was overdue all the same.
        const bool is_overdue = runner.give_up && IsOverdue(seat);
        if (!SetTask(seat, std::nullopt)) return;
        const RunTask& end = is_overdue ? runner.give_up : runner.keep;
        if (end) end(task);
        CountDone();
      }
    } catch (const Error& error) {
      if (!SetTask(seat, std::nullopt)) return;
      if (error.kind() != ErrorKind::kInterrupted) KeepFailure();
    } catch (...) {
      if (!SetTask(seat, std::nullopt)) return;
      KeepFailure();
    }
    const std::lock_guard lock(mutex_);
    --num_running_;
    finished_.notify_one();
  }

  bool Take(size_t& task) {
    const std::lock_guard lock(mutex_);
    if (stop_ || must_stop_ || next_ == num_tasks_) return false;
    task = next_++;
    return true;
  }

  /** Of a worker that was given up. */
  void Replace(const MakeTaskRunner& make_runner, size_t task) {
    try {
      Start(make_runner, task);
    } catch (const Error&) {
      KeepFailure();
    }
  }

  void CountDone() {
    const std::lock_guard lock(mutex_);
    ++num_done_;
  }

  /** False when the worker was given up meanwhile: it must touch nothing any more. */
  bool SetTask(Seat& seat, std::optional<size_t> task) {
    const std::lock_guard lock(mutex_);
    if (seat.is_abandoned) return false;
    seat.task = task;
    seat.clock = ThreadClock();
    seat.start = seat.clock.Now();
    return true;
  }

  bool IsOverdue(const Seat& seat) const { return seat.clock.Now() - seat.start >= time_limit_; }

  /** @pre the mutex is held. @returns the tasks of the workers that are given up now. */
  std::vector<size_t> AbandonOverdue() {
    std::vector<size_t> tasks;
    for (const auto& seat : seats_) {
      if (!seat->task || seat->is_abandoned) continue;
      if (!IsOverdue(*seat)) continue;
      seat->is_abandoned = true;
      ++num_abandoned;
      --num_running_;
      tasks.push_back(*seat->task);
    }
    return tasks;
  }

  void KeepFailure() {
    const std::lock_guard lock(mutex_);
    if (!failure_) failure_ = std::current_exception();
    must_stop_ = true;
  }

  const size_t num_tasks_;
  const std::atomic<bool>& stop_;
  const double time_limit_;
  std::atomic<bool> must_stop_ = false;
  std::mutex mutex_;  // guards everything below
  std::condition_variable finished_;
  std::vector<std::unique_ptr<Seat>> seats_;  // one a worker, by number
  size_t next_ = 0, num_done_ = 0;
  int num_running_ = 0;
  std::exception_ptr failure_;
};

}  // namespace

int CalcNumWorkers(int num_wanted, size_t num_tasks) {
  return std::max(1, static_cast<int>(std::min<size_t>(static_cast<size_t>(std::max(1, num_wanted)),
                                                       num_tasks)));
}

bool RunTasks(size_t num_tasks, int num_workers, const MakeTaskRunner& make_runner,
              const std::function<void()>& show, const std::atomic<bool>& stop, double time_limit) {
  num_workers = CalcNumWorkers(num_workers, num_tasks);
  const auto pool = std::make_shared<Pool>(num_tasks, stop, time_limit);
  try {
    for (int worker = show ? 0 : 1; worker < num_workers; ++worker) pool->Start(make_runner);
  } catch (const Error&) {  // those that have started still use what the caller gave
    pool->Stop();
    pool->Watch(make_runner, [] {});
    pool->Finish();
    throw;
  }
  if (show) {
    pool->Watch(make_runner, show);
  } else {
    pool->WorkHere(make_runner);
  }
  return pool->Finish();
}

bool HasAbandonedTasks() { return num_abandoned > 0; }

}  // namespace graspbench
