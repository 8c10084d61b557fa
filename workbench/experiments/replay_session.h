#pragma once
/** @file
Finished trials of a session carried out once more and compared with their records, field by field.
Nothing is written into the session's folder. */

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
  bool is_damaged = false;             ///< its line fails its checksum and is compared as it is
  Outcome outcome = Outcome::kNotRun;  ///< now
  std::optional<FieldDifference> difference;  ///< of record and result; unset: none
};

/** What may be the reason of a difference. */
struct ReplayConditions {
  int recorded_physics = 0, physics = 0;     ///< versions; 0: the session does not say
  std::vector<std::string> recorded_builds;  ///< each once; empty: not known
  std::string build;
  int num_changed = 0;  ///< planned trials that hand, object or grasp as they are now do not give

  bool is_other_physics() const { return recorded_physics != physics; }
  bool is_other_build() const;
};

struct SessionReplay {
  ReplayConditions conditions;
  std::vector<ReplayedTrial> trials;  ///< in the order they were asked for

  int CountDifferent() const;  ///< trials that differ from their record
  int CountMissing() const;    ///< trials without a record
};

/** Builds are those that have worked on the session, or on the campaign whose benchmark it is, as
far as run.json and the shards' logs say. */
ReplayConditions FindReplayConditions(const Session& session, const SessionInputs& inputs);

struct ReplayRequest {
  std::vector<PlannedTrial> trials;
  int num_workers = 1;
  double trial_time_limit = kTrialTimeLimit;  ///< [s of processor time]
  /** Takes what happened in a trial, in a worker's thread and in any order; empty: not requested. It
  has an instant a step. */
  std::function<void(size_t trial, const TrialSetup& setup, const TracedTrial& traced)> take = {};
};

/** @returns what was found; its conditions are left to FindReplayConditions.
@pre session and inputs belong together. @throws Error(kInterrupted) when stopped; Error(kNotFound)
when a hand no longer has the grasp; what `take` throws. */
SessionReplay ReplaySession(const Session& session, const SessionInputs& inputs,
                            const ReplayRequest& request, Observer& observer);

}  // namespace graspbench
