#pragma once
/** @file
What a lack of simultaneity might change of a trial: the list that `simultaneity_summary.h` relates
to the measured times and `delay_summary.h` to delays that were imposed. One more: a row. */

#include <string>
#include <vector>

#include "datasets/records/trial_record.h"

namespace graspbench {

/** A number as JSON names it and as people read it. */
struct ShownQuantity {
  const char* id = "";     ///< "shift_m"
  const char* label = "";  ///< "push before lift-off [mm]", which is
  double scale = 1.0;      ///< times the value, with
  int decimals = 0;
};

struct GraspResponse {
  ShownQuantity shown;
  /** NaN where it is not defined: of a lost object, of a numerical failure. */
  double (*value)(const TrialRecord& record);
};

/** success, push and turn before lift-off, slip in the hold, way and turn in the hand, sigma,
breaking force (judged trials). */
const std::vector<GraspResponse>& ListGraspResponses();
}  // namespace graspbench
