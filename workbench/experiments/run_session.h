#pragma once
/** @file
A session from its configuration to the last trial in its folder. */

#include <atomic>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "datasets/plan/session_config.h"
#include "datasets/plan/session_inputs.h"
#include "datasets/session/session_store.h"
#include "workbench/experiments/run_round.h"

namespace graspbench {

struct SessionRequest {
  std::optional<SessionConfig> config;  ///< none: that of the session to resume, or the benchmark
  std::string name = "benchmark";       ///< of the folder without `out`
  /** Empty: `results/NAME-HASH` with the hash of the plan, so the same session always has the same
  folder and another one never gets in its way; it is continued when it is there. */
  std::filesystem::path out;
  bool resume = false;                        ///< continue the session in `out`
  OnDamage on_damage = OnDamage::kRefuse;     ///< of the session to continue
  std::vector<std::filesystem::path> inputs;  ///< files read besides, which `out` must not hold
};

/** A new session, or the rest of one. */
struct PreparedSession {
  SessionConfig config;
  SessionInputs inputs;
  std::filesystem::path folder;
  Session session;
};

/** Loads what the session needs and creates its folder, or finds it there.
@throws Error(kUsage) for a folder with another session or with foreign files, as
CheckOutputFolder; what LoadSessionInputs, MakePlan,
CreateSession and LoadSession throw. */
PreparedSession PrepareSession(const SessionRequest& request);

/** Runs the trials that are left and adds itself to run.json. @returns that record. */
RunRecord RunSession(const PreparedSession& prepared, int num_workers, Observer& observer,
                     const std::atomic<bool>& stop, double trial_time_limit = kTrialTimeLimit);

/** Breaks the held grasps of a finished session that are not judged yet.
@param trial_time_limit  a grasp whose test has not ended by then stays unjudged.
@returns whether no grasp is left but those.
@throws Error(kVersion) when a trial gives another result than its record; Error(kUsage) when hands,
objects or physics have changed since. */
bool JudgeSession(const std::filesystem::path& folder, int num_workers, Observer& observer,
                  const std::atomic<bool>& stop, OnDamage on_damage = OnDamage::kRefuse,
                  double trial_time_limit = kTrialTimeLimit);

}  // namespace graspbench
