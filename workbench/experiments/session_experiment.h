#pragma once
/** @file
An experiment on the draws of a session: a session of its own with conditions
(datasets/plan/conditions.h), in the folder of the first, `KIND/HASH` with the hash of the plan. So
it is run, stopped, continued, sharded, merged, judged, verified and reported like any other. What
is there already, of the session and of earlier experiments of the kind, is not run again: a trial's
id hashes everything that decides it.

A kind of experiment is its conditions and its summary, in one file of datasets/analysis/conditions,
and its command. */

#include <atomic>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "datasets/plan/conditions.h"
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

using ListConditions = std::function<std::vector<Condition>(const SessionConfig& config)>;

/** Makes the experiment's folder, or finds it, with what is known already.
@param kind  "sensitivity", "numerics", "delays": a folder of the session.
@param list_conditions  asked with the session's configuration.
@throws Error(kUsage) without a finished trial, for a session that has conditions itself (thresholds
are found under each), and when
hands, objects or physics have changed since; kNotFound, kFormat, kVersion for the files. */
PreparedSession PrepareExperiment(const ExperimentRequest& request, const std::string& kind,
                                  const ListConditions& list_conditions);

/** That of grip thresholds; of a sweep, of all its conditions. @throws as PrepareExperiment and
ListThresholdGrips; Error(kRange) for a margin of an object without friction, and for forces with
touch: sensed of a hand that feels nothing. */
PreparedSession PrepareThresholds(const ExperimentRequest& request, const ThresholdScale& scale);

/** Runs what is left, of thresholds a round for each step of all bisections, then the judge where it
is asked for. @returns whether nothing is left. */
bool RunExperiment(const PreparedSession& experiment, const ExperimentRequest& request,
                   int num_workers, Observer& observer, const std::atomic<bool>& stop);

}  // namespace graspbench
