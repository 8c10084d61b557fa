#pragma once
/** @file
One trial of a session, simulated again and compared with its record, for the terminal and as JSON;
and what a replay of many has found. */

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
  std::optional<TrialResult> recorded;        ///< unset: not finished
  std::optional<FieldDifference> difference;  ///< of the two; unset: none
  std::optional<TrialRecord> nearest;         ///< successful trial of the cell; unset: none
  double nearest_distance = kUnset;           ///< of the two draws [m]
  /** What would have held: the session's, or found now; of a failure with a mechanism and without a
  controller. */
  std::optional<Explanation> explanation;
};

/** Of a failure that the session has not explained in full some 160 trials at most run
(core/trial/remedies.h).
@param interval  of the trace [s]; 0: every step.
@throws Error when the session's hand or object cannot be loaded any more. */
ExaminedTrial ExamineTrial(const Session& session, const PlannedTrial& planned, double interval);

/** "outcome  pushed away: REASON", a line. */
std::string FormatOutcome(const TrialResult& result);

/** Where the object was drawn: "x 1.2 mm, y -3.4 mm, yaw 5.6 deg". */
std::string FormatObjectDraw(const TrialDraw& draw);

/** Whether the trial is what its record says: "re-simulation matches the record". */
std::string FormatComparison(const ExaminedTrial& trial);

/** Outcome, draw, phases, contacts by digit, what failed first, the nearest success beside it.
@param folder  of the session, for the line that opens the trial again. */
std::string FormatTrial(const ExaminedTrial& trial, const std::string& folder);
Json MakeTrialJson(const ExaminedTrial& trial, const std::string& folder);

/** What replaying a session has found. @param with_all  a line for each trial; else for those that
are not as recorded. At the end how many are, and whether physics, build or inputs are those of the
session. */
std::string FormatReplay(const SessionReplay& replay, bool with_all);
Json MakeReplayJson(const SessionReplay& replay, const std::string& folder);

}  // namespace graspbench
