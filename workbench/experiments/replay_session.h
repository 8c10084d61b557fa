#pragma once
/** @file
Simulates finished trials of a session again and compares them with their records, field by field.
Writes nothing into the session's folder. */

#include <atomic>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/trial/trial_trace.h"
#include "datasets/plan/session_inputs.h"
#include "datasets/records/trial_record.h"
#include "datasets/session/session_store.h"
#include "workbench/experiments/observer.h"
#include "workbench/experiments/pool/batch_runner.h"

namespace graspbench {

struct ReplayedTrial {
  PlannedTrial planned;
  bool is_recorded = false;            ///< the session has finished it
  bool is_damaged = false;             ///< its line fails its checksum; it is compared nevertheless
  Outcome outcome = Outcome::kNotRun;  ///< of the replay
  std::optional<FieldDifference> difference;  ///< between record and replay; unset: none
};

/** Possible causes of a difference. */
struct ReplayConditions {
  int recorded_physics = 0, physics = 0;     ///< versions; 0: not stated by the session
  std::vector<std::string> recorded_builds;  ///< without duplicates; empty: unknown
  std::string build;
  int num_changed = 0;  ///< planned trials that the current hand, object or grasp do not yield

  bool is_other_physics() const { return recorded_physics != physics; }
  bool is_other_build() const;
};

struct SessionReplay {
  ReplayConditions conditions;
  std::vector<ReplayedTrial> trials;  ///< in the order of the request

  int CountDifferent() const;  ///< trials that differ from their record
  int CountMissing() const;    ///< trials without a record
};

/** Collects the conditions of a replay. Builds are those that have worked on the session, or on the
campaign whose benchmark it is, according to run.json and the shards' logs. */
ReplayConditions FindReplayConditions(const Session& session, const SessionInputs& inputs);

struct ReplayRequest {
  std::vector<PlannedTrial> trials;
  int num_workers = 1;
  double trial_time_limit = kTrialTimeLimit;  ///< [s of processor time]
  /** Receives the trace of a trial, in a worker's thread and in any order, with an instant per
  step; empty: no traces. */
  std::function<void(size_t trial, const TrialSetup& setup, const TracedTrial& traced)> take = {};
};

/** Replays trials. @returns the comparison; its conditions are left to FindReplayConditions.
@pre session and inputs belong together. @throws Error(kInterrupted) when stopped; Error(kNotFound)
when a hand no longer has the grasp; what `take` throws. */
SessionReplay ReplaySession(const Session& session, const SessionInputs& inputs,
                            const ReplayRequest& request, Observer& observer);

}  // namespace graspbench
