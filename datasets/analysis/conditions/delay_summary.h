#pragma once
/** @file
What a lack of simultaneity does when nothing else differs: the same trials with one digit delayed
(core/trial/digit_delays.h), on the same draws, the object as it was, lighter, more slippery and
farther from where the hand expects it. Late is the digit that touched last without delay, which
makes the contacts less simultaneous by the delay, or the one that touched first, which makes them
more so until it is the last.

Where a grasp ends is decided by its drives: two jaws that press bring the object back to where they
balance. So beside the push before lift-off there is the one until the last digit touches.

For each response the mean over the trials that have it at every delay, and the slope of a straight
line through each trial's values, averaged over trials, with the 95 % interval of a mean change
(datasets/analysis/pairs.h). Of failures only success, pushes and turns are defined, so the other
rows hold the trials that succeeded at every delay: what a delay costs in stability is seen among
grasps that survive it. */

#include <string>
#include <vector>

#include "core/base/text/csv.h"
#include "core/statistics/answer.h"
#include "core/statistics/proportion.h"
#include "core/trial/measures/object_in_hand.h"
#include "datasets/analysis/simultaneity_summary.h"
#include "datasets/session/session_store.h"

namespace graspbench {

/** Effects are told for so much delay [s]. */
inline constexpr double kDelayDose = 0.1;
/** The delays that are tried [s]; the first is none. */
const std::vector<double>& ListDelays();

struct DelayedTrial {
  std::string condition;  ///< "as run", "slippery"
  std::string digit;      ///< which was late: "last", "first" to touch without delay
  double delay = 0.0;     ///< [s], one of ListDelays()
  Displacement closing;   ///< of the object until the last digit touched
  TrialRecord record;     ///< its plan is that of the trial without delay
};

/** The object's other states and, under each of them and as run, every delay of either digit. */
std::vector<Condition> ListDelayConditions(const SessionConfig& config);

/** Of what is finished. Trials without two digits that touch have no delayed ones.
@pre the records are whole. */
std::vector<DelayedTrial> ListDelayedTrials(const Session& experiment);

/** One response of one hand under one condition. */
struct DoseResponse {
  std::string condition, digit, hand;
  ShownQuantity response;
  int num_trials = 0;
  int num_left_out = 0;  ///< trials without a value at some delay
  int num_objects = 0;
  std::vector<double> means;  ///< at each of ListDelays()
  double change = kUnset;     ///< for kDelayDose of delay: the mean slope times that
  Answer<Interval> interval;  ///< of the change, 95 %
};

/** GFT, to see that the delay arrived, what closing does, then ListGraspResponses(); in the order
in which conditions, digits and hands come. A response that no trial has is left out. */
std::vector<DoseResponse> SummariseDelays(const std::vector<DelayedTrial>& trials);

ShownTable ShowDoses(const std::vector<DoseResponse>& rows);
Json MakeDosesJson(const std::vector<DoseResponse>& rows);

}  // namespace graspbench
