#pragma once
/** @file
A trial as it went, thinned to a rate: what the files of trajectories hold. */

#include <memory>
#include <string>
#include <vector>

#include "core/hand/hand.h"
#include "core/shape/grasp_object.h"
#include "core/trial/trial_trace.h"
#include "datasets/plan/session_plan.h"

namespace graspbench {

inline constexpr double kTrajectoryRate = 60.0;  ///< instants a second where nobody asks

struct TrialTrajectory {
  PlannedTrial planned;
  std::string record_sha256;  ///< see CalcRecordSha256
  std::shared_ptr<const Hand> hand;
  std::shared_ptr<const GraspObject> object;
  double rate = kTrajectoryRate;  ///< [1/s]
  TracedTrial traced;             ///< its trace: the instants that are kept
};

/** SHA-256 of a trial's record: its journal line without the checksum, which is its line of
export/records.jsonl as long as it is not judged. */
std::string CalcRecordSha256(const PlannedTrial& planned, const TrialResult& result);

/** Keeps the first instant at or after each 1/rate since the start, the end of each phase and the
end of the trial: times are those of the physics, nothing is interpolated.
@param traced  with an instant a step.
@throws Error(kUnsupported) for a trial that could not begin. */
TrialTrajectory MakeTrajectory(const PlannedTrial& planned, const TrialSetup& setup,
                               const TracedTrial& traced, double rate);

/** What happened at a time: a phase that begins, or a contact event of the record. */
struct TrajectoryEvent {
  double time = 0.0;        ///< since the start of placing [s]
  std::string kind;         ///< "phase", "touch", "lost", "regained", "slip"
  std::string phase;        ///< of kind "phase"
  std::string digit;        ///< of a contact event; "palm" for links of none
  std::string link;         ///< of a contact event
  double impulse = kUnset;  ///< of "lost" [N s]
};
/** In the order of their times. */
std::vector<TrajectoryEvent> ListTrajectoryEvents(const TrialTrajectory& trajectory);

}  // namespace graspbench
