#pragma once
/** @file
An experiment on the draws of a session: a session of its own with conditions
(datasets/plan/conditions.h), in the folder of the first, `KIND/HASH` with the hash of the plan. So
it is run, stopped, continued, sharded, merged, judged, verified and reported like any other. What
is there already, of the session and of earlier experiments of the kind, is not run again: a trial's
id hashes everything that decides it.

A kind of experiment is its conditions and its summary, in one file of datasets/analysis/conditions,
and its command. A sweep (datasets/plan/conditions.h) is a session that has its conditions from
the start; a map of simultaneity (datasets/plan/map_design.h) is a sweep with more sessions below
it. */

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
  /** Look for the grip thresholds of all conditions, too; null: not. */
  const ThresholdScale* thresholds = nullptr;
  OnDamage on_damage = OnDamage::kRefuse;
  double trial_time_limit = kTrialTimeLimit;  ///< later a trial is a numerical failure [s]
  int num_workers = 1;
};

using ListConditions = std::function<std::vector<Condition>(const SessionConfig& config)>;

/** Makes the experiment's folder, or finds it, with what is known already.
@param kind  "sensitivity", "numerics", "delays": a folder of the session.
@param list_conditions  asked with the session's configuration.
@throws Error(kUsage) without a finished trial, for a session that has conditions itself (thresholds
are found under each), and when hands, objects or physics have changed since; kNotFound, kFormat,
kVersion for the files. */
PreparedSession PrepareExperiment(const ExperimentRequest& request, const std::string& kind,
                                  const ListConditions& list_conditions);

/** That of grip thresholds; of a sweep, of all its conditions. @throws as PrepareExperiment and
ListThresholdGrips; Error(kRange) for a margin of an object without friction, and for forces with
touch: sensed of a hand that feels nothing. */
PreparedSession PrepareThresholds(const ExperimentRequest& request, const ThresholdScale& scale);

/** Runs what is left, of thresholds a round for each step of all bisections; then the judge and the
thresholds that are asked for. @returns whether nothing is left. @throws as PrepareThresholds. */
bool RunExperiment(const PreparedSession& experiment, const ExperimentRequest& request,
                   Observer& observer);

/** Processor time of what is left of a sweep, judge and thresholds included, from the first trial
of each hand: for a person, in no result [s]. */
double EstimateSweepTime(const PreparedSession& sweep, bool with_judge, bool with_thresholds);

struct MapRequest {
  SessionConfig base;  ///< hands, objects, seed
  bool is_quick = false;
  std::filesystem::path out;  ///< empty: results/map-HASH
  OnDamage on_damage = OnDamage::kRefuse;
  double trial_time_limit = kTrialTimeLimit;  ///< later a trial is a numerical failure [s]
  int num_workers = 1;
};

/** Makes the folder of a map, or finds it: the session of success, which has the other parts below
it, each a session that can be continued, verified and reported by itself.
@throws as PrepareSession; Error(kUsage) for two objects that are the same body. */
PreparedSession PrepareMap(const MapRequest& request);

/** Runs what is left of all parts. @returns whether nothing is left.
@throws as PrepareSession, PrepareThresholds. */
bool RunMap(const PreparedSession& success, const MapRequest& request, Observer& observer);

}  // namespace graspbench
