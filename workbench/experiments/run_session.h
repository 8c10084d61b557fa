#pragma once
/** @file
A session from its configuration to the last trial in its folder, and the one runner of what it asks
for. A plan has rounds: first its trials; then, of what they held, the judge. What a round asks for
is computed from configuration, plan and the records of earlier rounds alone, so that every machine
has the same, and its own part of it from its shard. A round can be stopped anywhere: what is kept
is not asked for again.

A kind of round is one row: what it asks for, and what a worker does with it. Sessions, experiments
on their draws, the benchmark of a campaign and the shards of all of them run the same rounds. */

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

struct RoundKind {
  StageKind stage;
  const char* unit;   ///< "trial": what it asks for
  const char* label;  ///< before that of a shard in the files of its worker
  /** What is left, in the plan's order. */
  std::vector<PlannedTrial> (*find_left)(const Session& session);
  /** Each keeps what it finds in a file of its own. @param label  of a shard; empty: it has none.
  @pre session and inputs belong together and outlive the workers. */
  MakeBatchWorker (*make_workers)(const Session& session, const SessionInputs& inputs,
                                  const std::filesystem::path& folder, const std::string& label);
};

extern const RoundKind kTrialRound;      ///< the trials of a session
extern const RoundKind kBenchmarkRound;  ///< those of a campaign's benchmark
extern const RoundKind kJudgeRound;      ///< breaks what they held
extern const RoundKind kExplainRound;    ///< one failure of each condition, run again with remedies
extern const RoundKind kExplainAllRound;  ///< every failure
/** The same one of each shortly, as far as a report explains it unasked. */
extern const RoundKind kExplainShortlyRound;
/** Of grip thresholds what the bisection of each draw asks for next; asked again until it is
nothing. */
extern const RoundKind kThresholdRound;

/** That of a session's trials: kThresholdRound where its conditions are the grips of a scale. */
const RoundKind& FindTrialRound(const SessionConfig& config);

/** Runs what is left, seals the session before and after, and adds the run to run.json when there
was something to run. @pre session and inputs belong together.
@param trial_time_limit  of a trial [s of processor time]; a grasp whose judge has not ended by then
stays unjudged. @returns the run; finished: nothing is left but those.
@throws Error(kVersion) when a trial that is judged gives another result than its record;
Error(kIo); as RunTasks of worker_pool.h. */
RunRecord RunRound(const RoundKind& kind, const PreparedSession& prepared, int num_workers,
                   Observer& observer, double trial_time_limit = kTrialTimeLimit);

/** A finished session whose inputs are still those it was run with.
@throws Error(kUsage) when hands, objects or physics have changed since; as LoadSession. */
PreparedSession LoadFinished(const std::filesystem::path& folder, OnDamage on_damage);

struct JudgeRound {
  bool is_complete = true;      ///< false: stopped on request
  std::set<std::string> asked;  ///< trials whose grasps were not judged at the start
};

/** Breaks the held grasps of a session that are not judged yet, as it is at the start: a run may add
trials meanwhile.
@param trial_time_limit  a grasp whose test has not ended by then stays unjudged.
@throws Error(kVersion) when a trial gives another result than its record; Error(kUsage) when hands,
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
