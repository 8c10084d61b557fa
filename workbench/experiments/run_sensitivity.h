#pragma once
/** @file
The finished trials of a session again, on the same draws, under one changed setting after the
other (datasets/session/sensitivity_store.h). */

#include <atomic>
#include <filesystem>
#include <string>
#include <vector>

#include "datasets/session/session_store.h"
#include "workbench/experiments/observer.h"
#include "workbench/experiments/run_session.h"

namespace graspbench {

/** One or two other values for everything that nobody has measured or that was made up: half and
twice, less for friction, and none at all of the variation; every other coupling rule. What is out
of range or as the session has it is left out. */
std::vector<std::string> ListDefaultVariations(const SessionConfig& config);

struct SensitivityRequest {
  std::filesystem::path folder;       ///< of the session
  std::vector<std::string> settings;  ///< "sim.step_s=0.001"; empty: ListDefaultVariations
  int trials_per_cell = 0;            ///< the first finished ones; 0: all
  OnDamage on_damage = OnDamage::kRefuse;
  double trial_time_limit = kTrialTimeLimit;  ///< later a trial is a numerical failure [s]
};

/** Runs what is left; each setting is a stage. @returns whether nothing is left.
@throws Error(kUsage, kRange) for a setting that cannot be used or is named twice, before anything
runs; Error(kUsage) without a finished trial, or when hands, objects or physics have changed since.
*/
bool RunSensitivity(const SensitivityRequest& request, int num_workers, Observer& observer,
                    const std::atomic<bool>& stop);

}  // namespace graspbench
