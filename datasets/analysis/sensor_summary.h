#pragma once
/** @file
Summarises the sensors of a session: errors of the estimated object poses, and how contacts were
sensed. */

#include <string>
#include <vector>

#include "core/base/units.h"
#include "datasets/analysis/session_summary.h"

namespace graspbench {

/** Pose errors in one hand's trials with an object. NaN: the object was never found. */
struct PlaceErrors {
  std::string hand, object;
  int num_trials = 0, num_found = 0;
  double median = kUnset, worst = kUnset;            ///< of the position [m]
  double median_turn = kUnset, worst_turn = kUnset;  ///< of the yaw, modulo half a turn [rad]
};

/** Contacts in one hand's trials with sensed touch. */
struct FeltTouches {
  std::string hand;
  int num_trials = 0;
  TouchRecord sum;  ///< over the trials; of delays and peaks the largest
};

struct SensorSummary {
  std::vector<PlaceErrors> places;  ///< hands and objects in the order of the records
  std::vector<FeltTouches> touches;
};

SensorSummary SummariseSensors(const Session& session);

}  // namespace graspbench
