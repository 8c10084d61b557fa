#pragma once
/** @file
Sessions of a few short trials of the TUM Hand, in a folder of their own. */

#include <gtest/gtest.h>

#include <atomic>
#include <string>
#include <vector>

#include "tests/datasets/session/fake_session.h"
#include "workbench/experiments/session_experiment.h"

namespace graspbench {

class SmallSessions : public testing::Test {
 protected:
  static SessionConfig MakeConfig(const std::vector<std::string>& objects, int num_trials) {
    SessionConfig config;
    config.hands = {"tum"};
    config.objects = objects;
    config.trials = num_trials;
    return config;
  }
  PreparedSession Prepare(const std::string& name, const SessionConfig& config) {
    SessionRequest request;
    request.config = config;
    request.out = temporary_.path() / name;
    request.resume = HasSession(request.out);
    return PrepareSession(request);
  }
  /** A finished one, for experiments on it. */
  ExperimentRequest RunNew(const std::string& name, const SessionConfig& config) {
    ExperimentRequest request;
    request.folder = temporary_.path() / name;
    request.num_workers = 2;
    RunRound(kTrialRound, Prepare(name, config), 2, observer_);
    return request;
  }

  TemporaryFolder temporary_;
  std::atomic<bool> stop_{false};
  Observer observer_{stop_};
};

}  // namespace graspbench
