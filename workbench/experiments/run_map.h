#pragma once
/** @file
A map of simultaneity (datasets/plan/map_design.h) from its folder to its last trial: the session of
success, whose folder the map's is, and the other parts below it, each a session that can be
continued, verified and reported by itself. */

#include <filesystem>

#include "workbench/experiments/session_experiment.h"

namespace graspbench {

struct MapRequest {
  SessionConfig base;  ///< hands, objects, seed
  bool is_quick = false;
  std::filesystem::path out;  ///< empty: results/map-HASH
  OnDamage on_damage = OnDamage::kRefuse;
  double trial_time_limit = kTrialTimeLimit;  ///< later a trial is a numerical failure [s]
};

/** Makes the map's folder, or finds it. @throws as PrepareSession; Error(kUsage) for two objects
that are the same body. */
PreparedSession PrepareMap(const MapRequest& request);

/** Runs what is left of all parts. @returns whether nothing is left.
@throws as PrepareSession, PrepareThresholds. */
bool RunMap(const PreparedSession& success, const MapRequest& request, int num_workers,
            Observer& observer, const std::atomic<bool>& stop);

}  // namespace graspbench
