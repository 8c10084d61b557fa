#include "workbench/experiments/batch_runner.h"

#include <gtest/gtest.h>

#include <chrono>
#include <mutex>
#include <set>
#include <thread>

#include "core/base/error.h"

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

class BatchRunnerTest : public testing::Test {
 protected:
  BatchWorker MakeWorker() {
    return {RunFakeTrial, [this](const TrialRecord& record) {
              const std::lock_guard lock(mutex_);
              kept_.push_back(record.plan.id);
            }};
  }
  std::mutex mutex_;
  std::vector<std::string> kept_;
  std::atomic<bool> stop_{false};
  BatchStatus last_;
  ShowBatch show_ = [this](const BatchStatus& status) { last_ = status; };
};

TEST_F(BatchRunnerTest, RunsEveryTrialOnceForAnyNumberOfWorkers) {
  for (const int num_workers : {1, 2, 4, 100}) {
    kept_.clear();
    EXPECT_TRUE(RunBatch(
        MakeTrials(50), num_workers, [&](int) { return MakeWorker(); }, show_, stop_));
    EXPECT_EQ(kept_.size(), 50u);
    EXPECT_EQ(std::set<std::string>(kept_.begin(), kept_.end()).size(), 50u);
    EXPECT_EQ(last_.num_done, 50);
    EXPECT_EQ(last_.outcomes[Outcome::kNoContact], 17);
    EXPECT_EQ(last_.outcomes[Outcome::kSuccess], 33);
  }
}

TEST_F(BatchRunnerTest, OneWorkerKeepsThePlansOrder) {
  RunBatch(
      MakeTrials(20), 1, [&](int) { return MakeWorker(); }, show_, stop_);
  for (int i = 0; i < 20; ++i) EXPECT_EQ(kept_[i], std::to_string(i));
}

TEST_F(BatchRunnerTest, NothingToDoIsDone) {
  EXPECT_TRUE(RunBatch(
      {}, 4, [&](int) { return MakeWorker(); }, show_, stop_));
}

TEST_F(BatchRunnerTest, StopFinishesAndKeepsWhatHasBegun) {
  std::atomic<int> num_begun{0};
  const auto make_worker = [&](int) {
    BatchWorker worker = MakeWorker();
    worker.run = [&](const PlannedTrial& planned) {
      if (++num_begun == 5) stop_ = true;
      return RunFakeTrial(planned);
    };
    return worker;
  };
  EXPECT_FALSE(RunBatch(MakeTrials(1000), 2, make_worker, show_, stop_));
  EXPECT_EQ(static_cast<int>(kept_.size()), num_begun);
  EXPECT_LE(num_begun, 6);  // the other worker may have been in a trial
}

TEST_F(BatchRunnerTest, AFullDiskOfOneWorkerStopsAllAndLosesNothing) {
  std::atomic<int> num_run{0}, num_refused{0};
  const auto make_worker = [&](int number) {
    BatchWorker worker = MakeWorker();
    worker.run = [&](const PlannedTrial& planned) {
      ++num_run;
      return RunFakeTrial(planned);
    };
    if (number == 1) {
      worker.keep = [&](const TrialRecord&) {
        ++num_refused;
        throw Error(ErrorKind::kIo, "cannot write: No space left on device");
      };
    }
    return worker;
  };
  try {
    RunBatch(MakeTrials(1000000), 3, make_worker, show_, stop_);
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
  EXPECT_THROW(RunBatch(MakeTrials(10), 2, make_worker, show_, stop_), Error);
}

TEST_F(BatchRunnerTest, ShowsWhatTheWorkersAreDoing) {
  std::vector<std::string> seen;
  const auto make_worker = [&](int) {
    BatchWorker worker = MakeWorker();
    worker.run = [](const PlannedTrial& planned) {
      std::this_thread::sleep_for(std::chrono::milliseconds(250));
      return RunFakeTrial(planned);
    };
    return worker;
  };
  RunBatch(
      MakeTrials(1), 1, make_worker,
      [&](const BatchStatus& status) {
        ASSERT_EQ(status.busy.size(), 1u);
        seen.push_back(status.busy[0] ? status.busy[0]->id : "idle");
      },
      stop_);
  EXPECT_EQ(seen.front(), "0");
  EXPECT_EQ(seen.back(), "idle");
}

}  // namespace
}  // namespace graspbench
