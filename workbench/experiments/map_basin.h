#pragma once
/** @file
The robustness basin of one grasp, sampled (core/trial/basin.h). */

#include <atomic>
#include <string>
#include <vector>

#include "core/trial/basin.h"
#include "workbench/experiments/run_session.h"

namespace graspbench {

struct BasinRequest {
  std::string hand, object;
  std::string grasp = "best";
  int num_samples = 200;
  double trial_time_limit = kTrialTimeLimit;  ///< later a sample is a numerical failure [s]
};

struct BasinMap {
  std::string title;  ///< names of hand and object, id of the grasp
  std::vector<BasinSample> samples;
};

/** Tries every sample. @throws Error(kUsage) when the request names more than one grasp;
Error(kInterrupted); Error(kNotFound, kFormat) for the hand, the object or the grasp. */
BasinMap MapBasin(const BasinRequest& request, int num_workers, Observer& observer,
                  const std::atomic<bool>& stop);

}  // namespace graspbench
