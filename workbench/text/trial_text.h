#pragma once
/** @file
One trial of a session, simulated again and compared with its record, for the terminal and as JSON;
and the results of replaying many trials. */

#include <optional>
#include <string>

#include "core/base/text/json.h"
#include "core/trial/remedies.h"
#include "core/trial/trial_trace.h"
#include "datasets/records/trial_record.h"
#include "datasets/session/find_trial.h"
#include "workbench/experiments/replay_session.h"

namespace graspbench {

struct ExaminedTrial {
  PlannedTrial planned;
  TrialSetup setup;
  TracedTrial traced;
  std::optional<TrialResult> recorded;        ///< unset: trial not finished
  std::optional<FieldDifference> difference;  ///< between the two results; unset: none
  std::optional<TrialRecord> nearest;  ///< nearest successful trial of the condition; unset: none
  double nearest_distance = kUnset;    ///< between the two initial poses [m]
  /** What would have held the object: from the session, or computed now. Set for a failure with a
  mechanism and without a controller. */
  std::optional<Explanation> explanation;
};

/** Simulates the trial again. Some 160 trials at most are run for a failure that the session has
not explained in full (core/trial/remedies.h).
@param interval  of the trace [s]; 0: every step.
@throws Error when the session's hand or object can no longer be loaded. */
ExaminedTrial ExamineTrial(const Session& session, const PlannedTrial& planned, double interval);

/** One line: "outcome pushed away: REASON". */
std::string FormatOutcome(const TrialResult& result);

/** The sampled pose of the object: "x 1.2 mm, y -3.4 mm, yaw 5.6 deg". */
std::string FormatObjectDraw(const TrialDraw& draw);

/** Whether the trial equals its record: "re-simulation matches the record". */
std::string FormatComparison(const ExaminedTrial& trial);

/** Outcome, draw, phases, contacts by digit, what failed first, and the nearest success.
@param folder  of the session, for the command that opens the trial again. */
std::string FormatTrial(const ExaminedTrial& trial, const std::string& folder);
Json MakeTrialJson(const ExaminedTrial& trial, const std::string& folder);

/** Results of a replay, then the number of trials that match, and whether physics, build and inputs
are those of the session. @param with_all  a line for each trial; else only for trials that differ
from their records. */
std::string FormatReplay(const SessionReplay& replay, bool with_all);
Json MakeReplayJson(const SessionReplay& replay, const std::string& folder);

}  // namespace graspbench
