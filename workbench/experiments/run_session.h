#pragma once
/** @file
Runs a session from its configuration to the last trial in its folder. A plan has rounds: first the
trials, then the judge on the grasps that held. A round's tasks follow from the configuration, the
plan and the records of earlier rounds alone. Every machine therefore computes the same tasks, and
its share of them from its shard. A round can be stopped at any point: finished tasks are not
repeated.

Each kind of round is one table row: its tasks, and what a worker does with them. Sessions,
experiments on their draws, the benchmark of a campaign, and the shards of all of these run the same
rounds. */

#include <atomic>
#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "datasets/plan/session_config.h"
#include "datasets/plan/session_inputs.h"
#include "datasets/session/session_store.h"
#include "workbench/experiments/observer.h"
#include "workbench/experiments/pool/batch_runner.h"
#include "workbench/experiments/run_record.h"

namespace graspbench {

struct SessionRequest {
  std::optional<SessionConfig> config;  ///< unset: that of the session to resume, or the benchmark
  std::string name = "benchmark";       ///< in the folder's name, without `out`
  /** Empty: `results/NAME-HASH` with the hash of the plan, so that equal sessions share a folder
  and different ones never do. An existing session there is continued. */
  std::filesystem::path out;
  bool resume = false;                        ///< continue the session in `out`
  OnDamage on_damage = OnDamage::kRefuse;     ///< of the session to continue
  std::vector<std::filesystem::path> inputs;  ///< further files read, which `out` must not contain
};

/** A new session, or a session to continue. */
struct PreparedSession {
  SessionConfig config;
  SessionInputs inputs;
  std::filesystem::path folder;
  Session session;
};

/** Loads the session's inputs and creates its folder, or finds it there.
@throws Error(kUsage) for a folder with another session or with foreign files, as
CheckOutputFolder; what LoadSessionInputs, MakePlan,
CreateSession and LoadSession throw. */
PreparedSession PrepareSession(const SessionRequest& request);

struct RoundKind {
  StageKind stage;
  const char* unit;   ///< name of one task: "trial"
  const char* label;  ///< prefix of the shard's label in the names of worker files
  /** Finds the remaining tasks, in the plan's order. */
  std::vector<PlannedTrial> (*find_left)(const Session& session);
  /** Makes workers that each write their results to a file of their own. @param label  of a shard;
  empty: no shard.
  @pre session and inputs belong together and outlive the workers. */
  MakeBatchWorker (*make_workers)(const Session& session, const SessionInputs& inputs,
                                  const std::filesystem::path& folder, const std::string& label);
};

extern const RoundKind kTrialRound;       ///< trials of a session
extern const RoundKind kBenchmarkRound;   ///< trials of a campaign's benchmark
extern const RoundKind kJudgeRound;       ///< breaks the held grasps
extern const RoundKind kExplainRound;     ///< reruns one failure of each condition with remedies
extern const RoundKind kExplainAllRound;  ///< reruns every failure
/** As kExplainRound, but only the short explanations that a report shows by default. */
extern const RoundKind kExplainShortlyRound;
/** The next bisection step of each draw's grip threshold; repeated until none is left. */
extern const RoundKind kThresholdRound;

/** The round of a session's trials: kThresholdRound where its conditions are the grips of a
scale. */
const RoundKind& FindTrialRound(const SessionConfig& config);

/** Runs the remaining tasks, seals the session before and after, and adds the run to run.json if
there was anything to run. @pre session and inputs belong together.
@param trial_time_limit  per trial [s of processor time]; a grasp whose judgement takes longer stays
unjudged.
@returns the run; it is finished when nothing but such grasps is left.
@throws Error(kVersion) when a judged trial does not reproduce its record; Error(kIo); as RunTasks
of worker_pool.h. */
RunRecord RunRound(const RoundKind& kind, const PreparedSession& prepared, int num_workers,
                   Observer& observer, double trial_time_limit = kTrialTimeLimit);

/** Loads a finished session and checks that its inputs are unchanged.
@throws Error(kUsage) when hands, objects or physics have changed since; as LoadSession. */
PreparedSession LoadFinished(const std::filesystem::path& folder, OnDamage on_damage);

struct JudgeRound {
  bool is_complete = true;      ///< false: stopped on request
  std::set<std::string> asked;  ///< trials whose grasps were unjudged at the start
};

/** Breaks the unjudged held grasps of a session. The list is taken at the start, since a run may
add trials meanwhile.
@param trial_time_limit  a grasp whose test takes longer stays unjudged.
@throws Error(kVersion) when a trial does not reproduce its record; Error(kUsage) when hands,
objects or physics have changed since. */
JudgeRound JudgeSession(const std::filesystem::path& folder, int num_workers, Observer& observer,
                        OnDamage on_damage = OnDamage::kRefuse,
                        double trial_time_limit = kTrialTimeLimit);

/** Explains failures of a session (core/trial/remedies.h) that are not explained yet.
@returns whether nothing is left. @throws as JudgeSession. */
bool ExplainSession(const std::filesystem::path& folder, const RoundKind& kind, int num_workers,
                    Observer& observer, OnDamage on_damage = OnDamage::kRefuse,
                    double trial_time_limit = kTrialTimeLimit);

}  // namespace graspbench
