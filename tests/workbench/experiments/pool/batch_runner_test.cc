#include "workbench/experiments/pool/batch_runner.h"

#include <gtest/gtest.h>

#include <chrono>
#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <thread>

#include "core/base/error.h"
#include "workbench/experiments/pool/worker_pool.h"

namespace graspbench {
namespace {

std::vector<PlannedTrial> MakeTrials(int count) {
  std::vector<PlannedTrial> trials;
  for (int i = 0; i < count; ++i) {
    trials.push_back({std::to_string(i), "hand", "object", "g1", i});
  }
  return trials;
}

/** Stands for the simulation: every third trial fails, as a function of the trial alone. */
TrialResult RunFakeTrial(const PlannedTrial& planned) {
  TrialResult result;
  result.outcome = planned.trial % 3 == 0 ? Outcome::kNoContact : Outcome::kSuccess;
  return result;
}

/** A worker's trials by a function of the trial. */
template <class Run>
auto PrepareBy(const Run& run) {
  return [run](const PlannedTrial& planned) { return [run, planned] { return run(planned); }; };
}

class BatchRunnerTest : public testing::Test {
 protected:
  BatchWorker MakeWorker() {
    return {PrepareBy(RunFakeTrial), [this](const TrialRecord& record) {
              const std::lock_guard lock(mutex_);
              kept_.push_back(record.plan.id);
            }};
  }
  /** As a stage whose status `show` gets. */
  bool RunAll(const std::vector<PlannedTrial>& trials, int num_workers,
              const MakeBatchWorker& make_worker, double time_limit = kNoTimeLimit) {
    struct Watch : Observer {
      using Observer::Observer;
      void ShowStatus(const BatchStatus& status, int) override { show(status); }
      std::function<void(const BatchStatus&)> show;
    } observer(stop_);
    observer.show = show_;
    return RunBatch(MakeStage(StageKind::kRun, trials.size()), trials, num_workers, make_worker,
                    observer, time_limit);
  }
  std::mutex mutex_;
  std::vector<std::string> kept_;
  std::atomic<bool> stop_{false};
  BatchStatus last_;
  std::function<void(const BatchStatus&)> show_ = [this](const BatchStatus& status) {
    last_ = status;
  };
};

TEST_F(BatchRunnerTest, RunsEveryTrialOnceForAnyNumberOfWorkers) {
  for (const int num_workers : {1, 2, 4, 100}) {
    kept_.clear();
    EXPECT_TRUE(RunAll(MakeTrials(50), num_workers, [&](int) { return MakeWorker(); }));
    EXPECT_EQ(kept_.size(), 50u);
    EXPECT_EQ(std::set<std::string>(kept_.begin(), kept_.end()).size(), 50u);
    EXPECT_EQ(last_.num_done, 50);
    EXPECT_EQ(last_.outcomes[Outcome::kNoContact], 17);
    EXPECT_EQ(last_.outcomes[Outcome::kSuccess], 33);
  }
}

TEST_F(BatchRunnerTest, OneWorkerKeepsThePlansOrder) {
  RunAll(MakeTrials(20), 1, [&](int) { return MakeWorker(); });
  for (int i = 0; i < 20; ++i) EXPECT_EQ(kept_[i], std::to_string(i));
}

TEST_F(BatchRunnerTest, NothingToDoIsDone) {
  EXPECT_TRUE(RunAll({}, 4, [&](int) { return MakeWorker(); }));
}

TEST_F(BatchRunnerTest, StopFinishesAndKeepsWhatHasBegun) {
  std::atomic<int> num_begun{0};
  const auto make_worker = [&](int) {
    BatchWorker worker = MakeWorker();
    worker.prepare = PrepareBy([&](const PlannedTrial& planned) {
      if (++num_begun == 5) stop_ = true;
      return RunFakeTrial(planned);
    });
    return worker;
  };
  EXPECT_FALSE(RunAll(MakeTrials(1000), 2, make_worker));
  EXPECT_EQ(static_cast<int>(kept_.size()), num_begun);
  EXPECT_LE(num_begun, 6);  // the other worker may have been in a trial
}

TEST_F(BatchRunnerTest, AFullDiskOfOneWorkerStopsAllAndLosesNothing) {
  std::atomic<int> num_run{0}, num_refused{0};
  const auto make_worker = [&](int number) {
    BatchWorker worker = MakeWorker();
    worker.prepare = PrepareBy([&](const PlannedTrial& planned) {
      ++num_run;
      return RunFakeTrial(planned);
    });
    if (number == 1) {
      worker.keep = [&](const TrialRecord&) {
        ++num_refused;
        throw Error(ErrorKind::kIo, "cannot write: No space left on device");
      };
    }
    return worker;
  };
  try {
    RunAll(MakeTrials(1000000), 3, make_worker);
    FAIL() << "the error must come out";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::kIo);
    EXPECT_STREQ(error.what(), "cannot write: No space left on device");
  }
  EXPECT_EQ(num_refused, 1);
  EXPECT_EQ(static_cast<int>(kept_.size()), num_run - 1);
}

TEST_F(BatchRunnerTest, AWorkerThatCannotStartIsAnError) {
  const auto make_worker = [&](int) -> BatchWorker {
    throw Error(ErrorKind::kIo, "read-only folder");
  };
  EXPECT_THROW(RunAll(MakeTrials(10), 2, make_worker), Error);
}

// One trial never ends, on each number of workers: it is named, and the others go on.
TEST_F(BatchRunnerTest, AnEndlessTrialIsANumericalFailureAndTheOthersGoOn) {
  for (const int num_workers : {1, 3}) {
    const auto is_released = std::make_shared<std::atomic<bool>>(false);
    kept_.clear();
    std::map<std::string, TrialResult> results;
    std::set<int> numbers;
    const auto make_worker = [&, is_released](int number) {
      const std::lock_guard lock(mutex_);
      numbers.insert(number);
      BatchWorker worker;
      worker.prepare = PrepareBy([is_released](const PlannedTrial& planned) {
        while (planned.trial == 7 && !*is_released) {
        }
        return RunFakeTrial(planned);
      });
      worker.keep = [&](const TrialRecord& record) {
        const std::lock_guard own(mutex_);
        kept_.push_back(record.plan.id);
        results[record.plan.id] = record.result;
      };
      return worker;
    };
    EXPECT_TRUE(RunAll(MakeTrials(20), num_workers, make_worker, 0.3));
    EXPECT_EQ(kept_.size(), 20u);
    EXPECT_EQ(results.size(), 20u);
    EXPECT_EQ(results["7"].outcome, Outcome::kNumericalFailure);
    EXPECT_EQ(results["7"].reason, "the trial did not end within 0.3 s and was abandoned");
    EXPECT_EQ(last_.outcomes[Outcome::kNumericalFailure], 1);
    EXPECT_EQ(static_cast<int>(numbers.size()), num_workers + 1) << "one came in its stead";
    EXPECT_TRUE(HasAbandonedTasks());
    *is_released = true;  // it ends after all, too late
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    EXPECT_EQ(kept_.size(), 20u);
  }
}

TEST_F(BatchRunnerTest, ShowsWhatTheWorkersAreDoing) {
  std::vector<std::string> seen;
  const auto make_worker = [&](int) {
    BatchWorker worker = MakeWorker();
    worker.prepare = PrepareBy([](const PlannedTrial& planned) {
      std::this_thread::sleep_for(std::chrono::milliseconds(250));
      return RunFakeTrial(planned);
    });
    return worker;
  };
  show_ = [&](const BatchStatus& status) {
    ASSERT_EQ(status.busy.size(), 1u);
    seen.push_back(status.busy[0] ? status.busy[0]->id : "idle");
  };
  RunAll(MakeTrials(1), 1, make_worker);
  EXPECT_EQ(seen.front(), "0");
  EXPECT_EQ(seen.back(), "idle");
}

TEST_F(BatchRunnerTest, ShowsWhichObjectsArePrepared) {
  std::atomic<bool> is_seen{false};
  const auto make_worker = [&](int) {
    BatchWorker worker = MakeWorker();
    worker.prepare = [&](const PlannedTrial& planned) {
      while (!is_seen) std::this_thread::sleep_for(std::chrono::milliseconds(1));
      return PrepareBy(RunFakeTrial)(planned);
    };
    return worker;
  };
  const std::vector<PlannedTrial> trials = MakeTrials(1);
  std::map<int, std::string> last;
  show_ = [&](const BatchStatus& status) {
    last = status.preparing;
    if (last.empty()) return;
    EXPECT_EQ(last, (std::map<int, std::string>{{0, trials[0].object}}));
    EXPECT_FALSE(status.busy[0]);
    is_seen = true;
  };
  RunAll(trials, 1, make_worker);
  EXPECT_TRUE(is_seen);
  EXPECT_TRUE(last.empty());
}

}  // namespace
}  // namespace graspbench
