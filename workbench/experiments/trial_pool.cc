#include "workbench/experiments/trial_pool.h"

#include <algorithm>
#include <exception>
#include <thread>

#include "core/base/error.h"

namespace graspbench {

struct TrialPool::Worker {
  std::shared_ptr<const Hand> hand;
  std::shared_ptr<const GraspObject> object;
  std::unique_ptr<TrialRunner> runner;
  std::exception_ptr failure;

  TrialResult Run(const TrialSetup& setup) {
    if (setup.hand != hand || setup.object != object) {
      runner = std::make_unique<TrialRunner>(setup.hand, setup.object);
      hand = setup.hand;
      object = setup.object;
    }
    return runner->Run(setup);
  }
};

TrialPool::TrialPool(int num_workers, const std::atomic<bool>& stop) : stop_(stop) {
  for (int i = 0; i < num_workers; ++i) workers_.push_back(std::make_unique<Worker>());
}

TrialPool::~TrialPool() = default;

std::vector<TrialResult> TrialPool::Run(const std::vector<TrialSetup>& setups) {
  std::vector<TrialResult> results(setups.size());
  std::atomic<size_t> next = 0;
  const auto work = [&](Worker& worker) {
    try {
      for (size_t i = next++; i < setups.size() && !stop_; i = next++) {
        results[i] = worker.Run(setups[i]);
      }
    } catch (...) {
      worker.failure = std::current_exception();
    }
  };
  std::vector<std::thread> threads;
  const size_t num_threads = std::min(workers_.size(), setups.size());
  for (size_t i = 1; i < num_threads; ++i) threads.emplace_back(work, std::ref(*workers_[i]));
  work(*workers_.front());
  for (std::thread& thread : threads) thread.join();
  for (const auto& worker : workers_) {
    if (worker->failure) std::rethrow_exception(worker->failure);
  }
  if (stop_) throw Error(ErrorKind::kInterrupted, "stopped");
  return results;
}

}  // namespace graspbench
