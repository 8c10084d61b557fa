#pragma once
/** @file
The effect of less simultaneous contacts when nothing else differs: the same draws with one digit
delayed (core/trial/digit_delays.h), with the object as run, lighter, more slippery, and farther off
the expected pose. Either the digit that touched last without delay is delayed, which makes contacts
less simultaneous, or the one that touched first, which makes them more simultaneous until it
becomes the last.

The final pose of a grasp is decided by its drives: two pressing jaws move the object back to where
they balance. So the push until the last digit touches is measured as well as the push before
lift-off.

For each response, the summary gives the mean over trials that have it at every delay, and the slope
of a line through each trial's values, averaged over trials, with the 95 % interval of a mean change
(datasets/analysis/pairs.h). In failed trials only success, pushes and turns are defined. So the
other rows include only trials that succeeded at every delay: the loss of stability is measured on
grasps that survive the delay. */

#include <string>
#include <vector>

#include "core/base/text/csv.h"
#include "core/statistics/answer.h"
#include "core/statistics/proportion.h"
#include "core/trial/measures/object_in_hand.h"
#include "datasets/analysis/simultaneity_summary.h"
#include "datasets/session/session_store.h"

namespace graspbench {

/** Effects are reported per this delay [s]. */
inline constexpr double kDelayDose = 0.1;
/** The simulated delays [s]; the first is 0. */
const std::vector<double>& ListDelays();

struct DelayedTrial {
  std::string condition;  ///< state of the object: "as run", "slippery"
  std::string digit;      ///< delayed digit: "last" or "first" to touch without delay
  double delay = 0.0;     ///< [s], one of ListDelays()
  Displacement closing;   ///< of the object, until the last digit touched
  TrialRecord record;     ///< with the plan of the trial without delay
};

/** Lists the object's other states and, for each of them and as run, every delay of either
digit. */
std::vector<Condition> ListDelayConditions(const SessionConfig& config);

/** Lists the finished trials. A trial in which fewer than two digits touch has no delayed trials.
@pre the records are complete. */
std::vector<DelayedTrial> ListDelayedTrials(const Session& experiment);

/** One response of one hand under one condition. */
struct DoseResponse {
  std::string condition, digit, hand;
  ShownQuantity response;
  int num_trials = 0;
  int num_left_out = 0;  ///< trials without a value at some delay
  int num_objects = 0;
  std::vector<double> means;  ///< at each of ListDelays()
  double change = kUnset;     ///< mean slope times kDelayDose
  Answer<Interval> interval;  ///< of the change, 95 %
};

/** Summarises GFT, as a check of the imposed delay, push and turn during closure, then
ListGraspResponses(), in the order of conditions, digits and hands. Responses that no trial has are
left out. */
std::vector<DoseResponse> SummariseDelays(const std::vector<DelayedTrial>& trials);

ShownTable ShowDoses(const std::vector<DoseResponse>& rows);
Json MakeDosesJson(const std::vector<DoseResponse>& rows);

}  // namespace graspbench
