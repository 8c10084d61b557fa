#pragma once
/** @file
The one pool of workers: independent tasks on several threads, taken in their order. A task runs on
one thread from start to end and nothing passes from one to the next, so that results do not depend
on the number of workers. It knows neither physics nor files. */

#include <atomic>
#include <cstddef>
#include <functional>

namespace graspbench {

using RunTask = std::function<void(size_t task)>;
/** Called in the worker's own thread, before its first task. `must_stop` is set when the pool is to
end: a long task may look at it and give up by throwing Error(kInterrupted). */
using MakeTaskRunner = std::function<RunTask(int worker, const std::atomic<bool>& must_stop)>;

/** The number of threads for so many tasks: at least 1, no more than there are tasks. */
int CalcNumWorkers(int num_wanted, size_t num_tasks);

/** Runs tasks 0 .. num_tasks - 1 until all are done or `stop` is set; a task that has begun is
finished, or gives up.
@param show  called about ten times a second in the caller's thread, and once at the end; empty: the
caller's thread works too.
@returns whether all tasks are done.
@throws the first exception of a worker, Error(kInterrupted) aside, when the others have finished
their current tasks. */
bool RunTasks(size_t num_tasks, int num_workers, const MakeTaskRunner& make_runner,
              const std::function<void()>& show, const std::atomic<bool>& stop);

}  // namespace graspbench
