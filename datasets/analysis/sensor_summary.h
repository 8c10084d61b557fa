#pragma once
/** @file
What the sensors of a session found: where the hand took the objects to be, against where they lay,
and what it felt of its touches. */

#include <string>
#include <vector>

#include "core/base/units.h"
#include "datasets/analysis/session_summary.h"

namespace graspbench {

/** Of one hand's trials with an object. NaN: none was found. */
struct PlaceErrors {
  std::string hand, object;
  int num_trials = 0, num_found = 0;
  double median = kUnset, worst = kUnset;            ///< of the position [m]
  double median_turn = kUnset, worst_turn = kUnset;  ///< of the direction, half-turns apart [rad]
};

/** Of one hand's trials that went by sensed touch. */
struct FeltTouches {
  std::string hand;
  int num_trials = 0;
  TouchRecord sum;  ///< delays and peaks: the largest of the trials
};

struct SensorSummary {
  std::vector<PlaceErrors> places;  ///< hands and objects in the order of the records
  std::vector<FeltTouches> touches;
};

SensorSummary SummariseSensors(const Session& session);

}  // namespace graspbench
