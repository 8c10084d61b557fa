#pragma once
/** @file
The one pool of workers: independent tasks on several threads, taken in their order. A task runs on
one thread from start to end and nothing passes from one to the next, so that results do not depend
on the number of workers. It knows neither physics nor files. */

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

  /** What the task needs and what takes no part of its time; may be empty. */
  RunTask prepare;
  /** The work. A task that may be given up must from then on touch only what its thread owns. */
  RunTask run;
  /** Keeps what `run` has found, if the task has ended in time; may be empty. */
  RunTask keep;
  /** Keeps that a task, of this worker or of another, has not ended in time; empty: it is waited
  for. */
  RunTask give_up;
};

/** Called in the worker's own thread, before its first task. `must_stop` is set when the pool is to
end: a long task may look at it and give up by throwing Error(kInterrupted). */
using MakeTaskRunner = std::function<TaskRunner(int worker, const std::atomic<bool>& must_stop)>;

/** The number of threads for so many tasks: at least 1, no more than there are tasks. */
int CalcNumWorkers(int num_wanted, size_t num_tasks);

/** Runs tasks 0 .. num_tasks - 1 until all are done or `stop` is set; a task that has begun is
finished, or gives up.
@param show  called about ten times a second in the caller's thread, and once at the end; empty: the
caller's thread works too.
@returns whether all tasks are done.
@param time_limit  of a task [s of processor time]: what took longer is given up. With a `show` that
does not wait for its end: the worker is replaced by one with a new number, which calls give_up.
@throws the first exception of a worker, Error(kInterrupted) aside, when the others have finished
their current tasks. */
bool RunTasks(size_t num_tasks, int num_workers, const MakeTaskRunner& make_runner,
              const std::function<void()>& show, const std::atomic<bool>& stop,
              double time_limit = std::numeric_limits<double>::infinity());

/** True when a thread that was given up may still run: the program must not end by returning from
main, which would take the ground from under it. */
bool HasAbandonedTasks();

}  // namespace graspbench
