#pragma once
/** @file
An experiment on the draws of a session: a session of its own with conditions
(datasets/plan/conditions.h), in the folder of the first, `KIND/HASH` with the hash of the plan. So
it is run, stopped, continued, sharded, merged, judged, verified and reported like any other. What
is there already, of the session and of earlier experiments of the kind, is not run again: a trial's
id hashes everything that decides it.

A kind of experiment is its conditions and its summary: run_sensitivity, numerics_check and
delay_sweep have a file each. */

#include <atomic>
#include <filesystem>
#include <string>
#include <vector>

#include "workbench/experiments/run_session.h"

namespace graspbench {

struct ExperimentRequest {
  std::filesystem::path folder;  ///< of the session
  int trials_per_cell = 0;       ///< the first ones; 0: all
  bool plan_only = false;        ///< for several machines: nothing runs
  bool with_judge = false;       ///< break what is held, too
  OnDamage on_damage = OnDamage::kRefuse;
  double trial_time_limit = kTrialTimeLimit;  ///< later a trial is a numerical failure [s]
};

inline constexpr char kThresholdKind[] = "thresholds";  ///< see grip_thresholds.h

/** Makes the experiment's folder, or finds it, with what is known already.
@param kind  "sensitivity", "numerics", "delays": a folder of the session.
@throws Error(kUsage) without a finished trial, for a session that has conditions itself (thresholds
are found under each), and when
hands, objects or physics have changed since; kNotFound, kFormat, kVersion for the files. */
PreparedSession PrepareExperiment(const Session& session, const std::string& kind,
                                  const std::vector<Condition>& conditions,
                                  const ExperimentRequest& request);

/** Runs what is left. @returns whether nothing is left. */
bool RunExperiment(const PreparedSession& experiment, const ExperimentRequest& request,
                   int num_workers, Observer& observer, const std::atomic<bool>& stop);

}  // namespace graspbench
