#pragma once
/** @file
An experiment on the draws of a session: a session of its own with conditions
(datasets/plan/conditions.h), in the folder `KIND/HASH` of the first, with the hash of the plan. So
it is run, stopped, continued, sharded, merged, judged, verified and reported like any other. Trials
that the session or earlier experiments of the kind have finished are not run again: a trial's id
hashes everything that determines it.

A kind of experiment consists of its conditions and summary, in one file of
datasets/analysis/conditions, and its command. A sweep (datasets/plan/conditions.h) is a session
that has conditions from the start. A simultaneity map (datasets/plan/map_design.h) is a sweep with
further sessions below it. */

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "datasets/plan/conditions.h"
#include "workbench/experiments/run_session.h"

namespace graspbench {

struct ExperimentRequest {
  std::filesystem::path folder;  ///< of the session
  int trials_per_cell = 0;       ///< the first ones per cell; 0: all
  bool plan_only = false;        ///< only plan, for several machines
  bool with_judge = false;       ///< also break held grasps
  /** Also find the grip thresholds of all conditions on this scale; null: do not. */
  const ThresholdScale* thresholds = nullptr;
  OnDamage on_damage = OnDamage::kRefuse;
  double trial_time_limit = kTrialTimeLimit;  ///< a longer trial is a numerical failure [s]
  int num_workers = 1;
};

using ListConditions = std::function<std::vector<Condition>(const SessionConfig& config)>;

/** Creates the experiment's folder, or finds it, with all results known already.
@param kind  "sensitivity", "numerics", "delays": the subfolder of the session.
@param list_conditions  called with the session's configuration.
@throws Error(kUsage) without a finished trial, for a session that itself has conditions (except for
thresholds, which are found under each), and when hands, objects or physics have changed since;
kNotFound, kFormat, kVersion for the files. */
PreparedSession PrepareExperiment(const ExperimentRequest& request, const std::string& kind,
                                  const ListConditions& list_conditions);

/** Prepares the experiment for grip thresholds; for a sweep, under all its conditions. @throws as
PrepareExperiment and ListThresholdGrips; Error(kRange) for a margin on an object without friction,
and for forces with `touch: sensed` on a hand without tactile elements. */
PreparedSession PrepareThresholds(const ExperimentRequest& request, const ThresholdScale& scale);

/** Runs the remaining trials; for thresholds, one round per step of all bisections. Then runs the
judge and the thresholds if requested. @returns whether nothing is left. @throws as
PrepareThresholds. */
bool RunExperiment(const PreparedSession& experiment, const ExperimentRequest& request,
                   Observer& observer);

/** Estimates the processor time of the remaining sweep [s], including judge and thresholds, from
the first trial of each hand. It is shown to the user and enters no result. */
double EstimateSweepTime(const PreparedSession& sweep, bool with_judge, bool with_thresholds);

struct MapRequest {
  SessionConfig base;  ///< hands, objects, seed
  bool is_quick = false;
  std::filesystem::path out;  ///< empty: results/map-HASH
  OnDamage on_damage = OnDamage::kRefuse;
  double trial_time_limit = kTrialTimeLimit;  ///< a longer trial is a numerical failure [s]
  int num_workers = 1;
};

/** Creates the folder of a map, or finds it. It is the session for success; the other parts lie
below it, each a session that can be continued, verified and reported by itself.
@throws as PrepareSession; Error(kUsage) for two objects with the same body. */
PreparedSession PrepareMap(const MapRequest& request);

/** Runs the remaining trials of all parts. @returns whether nothing is left.
@throws as PrepareSession, PrepareThresholds. */
bool RunMap(const PreparedSession& success, const MapRequest& request, Observer& observer);

}  // namespace graspbench
