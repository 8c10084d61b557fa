#pragma once
/** @file
A session's first trials of each cell again, on their own draws, with one digit delayed
(datasets/analysis/delay_summary.h), the object as it was, lighter, more slippery and farther from
where the hand expects it. Late is the digit that touched last without delay, which makes the
contacts less simultaneous by the delay, or the one that touched first, which makes them more so
until it is the last. */

#include <atomic>
#include <filesystem>
#include <string>
#include <vector>

#include "datasets/analysis/delay_summary.h"
#include "workbench/experiments/observer.h"

namespace graspbench {

struct SweepCondition {
  std::string name;
  std::vector<std::string> settings;  ///< "model.mass_scale=0.25"
};
/** Settings that a session allows; the first condition has none. */
std::vector<SweepCondition> ListSweepConditions(const SessionConfig& config);

struct DelaySweepRequest {
  std::filesystem::path folder;  ///< of the session
  int trials_per_cell = 1;
  bool with_judge = false;  ///< breaking forces, too; some five times the cost
};

/** Two stages a condition: without delay, with. Trials without two digits that touch have no
delayed ones. @returns the same for any number of workers. @throws Error(kUsage) when hands, objects
or physics have changed since the session; Error(kNotFound, kFormat, kVersion) for its files;
Error(kInterrupted). */
std::vector<DelayedTrial> SweepDelays(const DelaySweepRequest& request, int num_workers,
                                      Observer& observer, const std::atomic<bool>& stop);

}  // namespace graspbench
