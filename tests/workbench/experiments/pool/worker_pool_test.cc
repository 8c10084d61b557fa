#include "workbench/experiments/pool/worker_pool.h"

#include <gtest/gtest.h>
#include <time.h>

#include <chrono>
#include <set>
#include <thread>

#include "core/base/error.h"

namespace graspbench {
namespace {

TEST(WorkerPool, StartsNoMoreThreadsThanTasks) {
  EXPECT_EQ(CalcNumWorkers(4, 100), 4);
  EXPECT_EQ(CalcNumWorkers(4, 3), 3);
  EXPECT_EQ(CalcNumWorkers(4, 0), 1);
  EXPECT_EQ(CalcNumWorkers(-1, 7), 1);
}

/** @param seconds  of processor time. */
void Compute(double seconds) {
  const auto now = [] {
    timespec time = {};
    ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
  };
  for (const double end = now() + seconds; now() < end;) {
  }
}

// The caller's thread works when there is nothing to show: a pool within a pool starts no thread.
TEST(WorkerPool, OneWorkerWithoutAShowIsTheCaller) {
  const std::atomic<bool> never = false;
  std::set<std::thread::id> threads;
  const auto make_runner = [&](int, const std::atomic<bool>&) -> RunTask {
    return [&](size_t) { threads.insert(std::this_thread::get_id()); };
  };
  EXPECT_TRUE(RunTasks(5, 1, make_runner, {}, never));
  EXPECT_EQ(threads, std::set<std::thread::id>{std::this_thread::get_id()});
  EXPECT_TRUE(RunTasks(
      5, 1, make_runner, [] {}, never));
  EXPECT_EQ(threads.size(), 2u);
}

// A failure stops a long task of another worker through must_stop, and is what comes out.
TEST(WorkerPool, AFailureEndsLongTasksOfTheOthers) {
  const std::atomic<bool> never = false;
  const auto make_runner = [](int, const std::atomic<bool>& must_stop) -> RunTask {
    return [&must_stop](size_t task) {
      if (task == 0) throw Error(ErrorKind::kIo, "disk full");
      while (!must_stop) std::this_thread::sleep_for(std::chrono::milliseconds(1));
      throw Error(ErrorKind::kInterrupted, "gave up");
    };
  };
  try {
    RunTasks(2, 2, make_runner, {}, never);
    FAIL() << "the error must come out";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::kIo);
  }
}

TEST(WorkerPool, ATaskThatGivesUpIsNotDone) {
  std::atomic<bool> stop = false;
  const auto make_runner = [&](int, const std::atomic<bool>& must_stop) -> RunTask {
    return [&](size_t) {
      stop = true;
      while (!must_stop) std::this_thread::sleep_for(std::chrono::milliseconds(1));
      throw Error(ErrorKind::kInterrupted, "gave up");
    };
  };
  EXPECT_FALSE(RunTasks(
      3, 1, make_runner, [] {}, stop));
}

// What a task needs may take long to load; that is no part of its time.
TEST(WorkerPool, PreparingIsNoPartOfATasksTime) {
  const std::atomic<bool> never = false;
  std::atomic<int> num_kept = 0, num_given_up = 0;
  const auto make_runner = [&](int, const std::atomic<bool>&) -> TaskRunner {
    const auto prepare = [](size_t) { Compute(0.5); };
    return {prepare, [](size_t) {}, [&](size_t) { ++num_kept; }, [&](size_t) { ++num_given_up; }};
  };
  EXPECT_TRUE(RunTasks(
      2, 2, make_runner, [] {}, never, /*time_limit=*/0.2));
  EXPECT_EQ(num_kept, 2);
  EXPECT_EQ(num_given_up, 0);
}

// Whether somebody looked while it ran must not decide.
TEST(WorkerPool, AnOverdueTaskThatEndsUnseenIsGivenUp) {
  const std::atomic<bool> never = false;
  std::atomic<int> num_kept = 0, num_given_up = 0;
  const auto make_runner = [&](int, const std::atomic<bool>&) -> TaskRunner {
    const auto run = [](size_t) { Compute(0.02); };
    return {{}, run, [&](size_t) { ++num_kept; }, [&](size_t) { ++num_given_up; }};
  };
  EXPECT_TRUE(RunTasks(
      5, 1, make_runner, [] {}, never, /*time_limit=*/0.01));
  EXPECT_EQ(num_kept, 0);
  EXPECT_EQ(num_given_up, 5);
}

// A busy machine or a program that was suspended makes no trial a failure.
TEST(WorkerPool, OnlyComputingIsATasksTime) {
  const std::atomic<bool> never = false;
  static std::atomic<bool> is_over = false;  // a worker that was given up outlives the pool
  static std::atomic<int> num_kept = 0, num_given_up = 0;
  const auto make_runner = [](int, const std::atomic<bool>&) -> TaskRunner {
    const auto run = [](size_t task) {
      if (task == 0) std::this_thread::sleep_for(std::chrono::seconds(1));
      while (task == 1 && !is_over) Compute(0.01);
    };
    return {{},
            run,
            [](size_t task) { num_kept += task == 0; },
            [](size_t task) { num_given_up += task == 1; }};
  };
  EXPECT_TRUE(RunTasks(
      2, 2, make_runner, [] {}, never, /*time_limit=*/0.2));
  EXPECT_EQ(num_kept, 1);
  EXPECT_EQ(num_given_up, 1);
  is_over = true;
}

}  // namespace
}  // namespace graspbench
