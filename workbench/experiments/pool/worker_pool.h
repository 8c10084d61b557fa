#pragma once
/** @file
The program's only worker pool: independent tasks on several threads, started in order. A task runs
on one thread from start to end, and tasks share no state, so that results do not depend on the
number of workers. It knows neither physics nor files. */

#include <atomic>
#include <cstddef>
#include <functional>
#include <limits>
#include <utility>

namespace graspbench {

using RunTask = std::function<void(size_t task)>;

/** What one worker does with a task. */
struct TaskRunner {
  TaskRunner(RunTask whole) : run(std::move(whole)) {}
  TaskRunner(RunTask tools, RunTask work, RunTask result, RunTask none)
      : prepare(std::move(tools)),
        run(std::move(work)),
        keep(std::move(result)),
        give_up(std::move(none)) {}

  /** Prepares the task, outside of its time limit; may be empty. */
  RunTask prepare;
  /** Does the work. A task that may be given up must then touch only data owned by its thread. */
  RunTask run;
  /** Keeps the result of `run`, if the task has ended in time; may be empty. */
  RunTask keep;
  /** Records that a task, of this worker or of another, has not ended in time; empty: the pool
  waits for it. */
  RunTask give_up;
};

/** Called in the worker's own thread, before its first task. `must_stop` is set when the pool is to
end: a long task may check it and abort by throwing Error(kInterrupted). */
using MakeTaskRunner = std::function<TaskRunner(int worker, const std::atomic<bool>& must_stop)>;

/** Number of threads for the tasks: at least 1, at most one per task. */
int CalcNumWorkers(int num_wanted, size_t num_tasks);

/** Runs tasks 0 .. num_tasks - 1 until all are done or `stop` is set; a task that has begun is
finished or aborts itself.
@param show  called about ten times a second in the caller's thread, and once at the end; empty: the
caller's thread works too.
@returns whether all tasks are done.
@param time_limit  per task [s of processor time]: a longer task is given up. With `show`, the pool
does not wait for its end: the worker is replaced by one with a new number, which calls give_up.
@throws the first exception of a worker other than Error(kInterrupted), after the others have
finished their current tasks. */
bool RunTasks(size_t num_tasks, int num_workers, const MakeTaskRunner& make_runner,
              const std::function<void()>& show, const std::atomic<bool>& stop,
              double time_limit = std::numeric_limits<double>::infinity());

/** True when an abandoned thread may still run. The program must then not end by returning from
main, which would destroy objects that the thread uses. */
bool HasAbandonedTasks();

}  // namespace graspbench
