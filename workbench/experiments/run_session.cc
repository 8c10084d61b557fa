#include "workbench/experiments/run_session.h"

#include <algorithm>
#include <map>
#include <memory>

#include "core/base/error.h"
#include "core/base/hash.h"
#include "core/trial/judge/judge.h"
#include "datasets/analysis/conditions/threshold_summary.h"
#include "datasets/plan/failed_trial.h"
#include "datasets/plan/grip_check.h"
#include "datasets/plan/session_inputs.h"
#include "datasets/session/explanation_store.h"
#include "datasets/session/judgement_store.h"
#include "datasets/shards/worker_log.h"
#include "workbench/experiments/output_folder.h"
#include "workbench/experiments/policies/live_policies.h"
#include "workbench/experiments/policies/policy_files.h"
#include "workbench/experiments/pool/batch_runner.h"

namespace graspbench {
namespace fs = std::filesystem;

namespace {

fs::path FindFolder(const SessionRequest& request, const std::vector<PlannedTrial>& plan,
                    const std::map<std::string, std::string>& policy_files) {
  if (!request.out.empty()) return request.out;
  std::string ids;
  for (const PlannedTrial& planned : plan) ids += planned.id;
  for (const auto& [name, digest] : policy_files) ids += digest;
  return fs::path("results") / (request.name + "-" + CalcHashHex(ids).substr(0, 8));
}

void CheckSameResult(const Session& session, const PlannedTrial& planned,
                     const TrialResult& result) {
  const auto record =
      std::find_if(session.records.begin(), session.records.end(),
                   [&](const TrialRecord& candidate) { return candidate.plan == planned; });
  if (ToJson(LoadWhole(session, *record).result) == ToJson(result)) return;
  throw Error(ErrorKind::kVersion,
              "trial " + planned.id + " (" + DescribeTrial(planned) +
                  ") does not reproduce its record: the session was run by another build or on "
                  "another machine; run it again to judge or explain it");
}

MakeBatchWorker MakeSessionWorkers(const Session& session, const SessionInputs& inputs,
                                   const fs::path& folder, const std::string& label) {
  CheckPolicyFiles(folder);
  return [&session, &inputs, folder, label](int worker) {
    const auto journal = std::make_shared<JournalWriter>(folder, worker, label);
    return MakeTrialWorker(session.config, inputs,
                           [journal](const TrialRecord& record) { journal->Append(record); });
  };
}

/** Workers that run finished trials again, with the judge, and write what it finds.
@throws (in a worker) Error(kVersion) when a trial gives another result than its record. */
MakeBatchWorker MakeJudgeWorkers(const Session& session, const SessionInputs& inputs,
                                 const fs::path& folder, const std::string& label) {
  return [&session, &inputs, folder, label](int worker) {
    const auto writer = std::make_shared<JudgementWriter>(folder, worker, label);
    const auto judgement = std::make_shared<Judgement>();  // of the trial that has just run
    const auto keep = [&session, writer, judgement](const TrialRecord& record) {
      CheckSameResult(session, record.plan, record.result);
      writer->Append(record.plan.id, *judgement);
    };
    BatchWorker made = MakeTrialWorker(
        session.config, inputs, keep,
        [judgement](TrialRunner& runner, const TrialSetup& setup) {
          JudgedTrial trial = runner.Judge(setup);
          *judgement = trial.judgement ? *trial.judgement : MakeEmptyHandJudgement();
          return trial.result;
        },
        MakeRecordedPolicies(session));
    // Nothing is known of a grasp whose test does not end: it stays unjudged.
    made.give_up = [](const TrialRecord&) {};
    return made;
  };
}

/** Workers that run failed trials again, with remedies, and write what held.
@throws (in a worker) Error(kVersion) when a trial gives another result than its record. */
template <ExplainDepth depth>
MakeBatchWorker MakeExplainWorkers(const Session& session, const SessionInputs& inputs,
                                   const fs::path& folder, const std::string& label) {
  return [&session, &inputs, folder, label](int worker) {
    const auto writer = std::make_shared<ExplanationWriter>(folder, worker, label);
    const auto bench = std::make_shared<TrialBench>();
    const auto explanation = std::make_shared<Explanation>();  // of the trial that has just run
    BatchWorker made;
    made.prepare = [&session, &inputs, bench,
                    explanation](const PlannedTrial& planned) -> std::function<TrialResult()> {
      TrialSetup setup = MakeTrialSetup(session.config, inputs, planned);
      TrialRunner& runner = bench->Prepare(setup);
      const auto failed = std::make_shared<FailedTrial>(
          MakeFailedTrial(session.config, inputs, planned, setup, depth));
      return [bench, &runner, failed, explanation] {
        failed->result = runner.Run(failed->setup);
        *explanation = ExplainFailure(runner, *failed, depth);
        return failed->result;
      };
    };
    made.keep = [&session, writer, explanation](const TrialRecord& record) {
      CheckSameResult(session, record.plan, record.result);
      writer->Append(record.plan.id, *explanation);
    };
    made.give_up = [](const TrialRecord&) {};
    return made;
  };
}

template <ExplainScope scope>
std::vector<PlannedTrial> FindUnexplainedOf(const Session& session) {
  return FindUnexplained(session, scope);
}

/** Trials go on where earlier runs ended. */
Stage MakeRoundStage(const RoundKind& kind, const Session& session, size_t num_left) {
  Stage stage = MakeStage(kind.stage, num_left);
  if (kind.find_left != FindUnfinished) return stage;
  stage.num_all = stage.num_trials = static_cast<int>(session.plan.size());
  for (const TrialRecord& finished : session.records) ++stage.before[finished.result.outcome];
  return stage;
}

}  // namespace

PreparedSession PrepareSession(const SessionRequest& request) {
  PreparedSession prepared;
  const bool names_a_session = request.resume && !request.out.empty();
  if (names_a_session)
    prepared.session = LoadSession(request.out, request.on_damage, RecordParts::kBrief);
  if (request.config) {
    prepared.config = *request.config;
    DropUnusedGrip(prepared.config.strategy);
  } else if (names_a_session) {
    prepared.config = prepared.session.config;
  }
  // Whoever names the inputs again asks whether they are still the same.
  prepared.inputs = LoadSessionInputs(prepared.config, FieldUse::kLater,
                                      request.config ? fs::path() : prepared.session.folder);
  const std::vector<PlannedTrial> plan = MakePlan(prepared.config, prepared.inputs);
  const std::map<std::string, std::string> policy_files =
      FindPolicyFiles(prepared.config, prepared.inputs);
  prepared.folder = FindFolder(request, plan, policy_files);
  const bool may_continue = request.resume || request.out.empty();
  if (!HasSession(prepared.folder)) {
    CheckPolicies(prepared.config, prepared.inputs, plan);
    StagedFolder staged({prepared.folder, "", false, request.inputs});
    CopyInputs(prepared.config, staged.path());
    CopyRehearsed(prepared.inputs, staged.path());
    KeepPolicyFiles(policy_files, staged.path());
    CreateSession(staged.path(), prepared.config, plan);
    staged.Commit();
  } else if (!may_continue) {
    CreateSession(prepared.folder, prepared.config, plan);  // says what is there
  }
  if (!names_a_session)
    prepared.session = LoadSession(prepared.folder, request.on_damage, RecordParts::kBrief);
  CheckSameSession(prepared.session, prepared.config, plan);
  return prepared;
}

const RoundKind kTrialRound = {StageKind::kRun, "trial", "", FindUnfinished, MakeSessionWorkers};
const RoundKind kBenchmarkRound = {StageKind::kBenchmark, "trial", "", FindUnfinished,
                                   MakeSessionWorkers};
const RoundKind kJudgeRound = {StageKind::kJudge, "held grasp", kJudgeLabel, FindUnjudged,
                               MakeJudgeWorkers};
const RoundKind kExplainRound = {StageKind::kExplain, "failure", kExplainLabel,
                                 FindUnexplainedOf<ExplainScope::kOneOfEach>,
                                 MakeExplainWorkers<ExplainDepth::kFull>};
const RoundKind kExplainAllRound = {StageKind::kExplain, "failure", kExplainLabel,
                                    FindUnexplainedOf<ExplainScope::kAll>,
                                    MakeExplainWorkers<ExplainDepth::kFull>};
const RoundKind kExplainShortlyRound = {StageKind::kExplain, "failure", kExplainLabel,
                                        FindUnexplainedOf<ExplainScope::kShortly>,
                                        MakeExplainWorkers<ExplainDepth::kShort>};
const RoundKind kThresholdRound = {StageKind::kRun, "trial", "", FindThresholdTrials,
                                   MakeSessionWorkers};

const RoundKind& FindTrialRound(const SessionConfig& config) {
  return FindThresholdScale(config) ? kThresholdRound : kTrialRound;
}

RunRecord RunRound(const RoundKind& kind, const PreparedSession& prepared, int num_workers,
                   Observer& observer, double trial_time_limit) {
  const Session& session = prepared.session;
  const std::vector<PlannedTrial> trials = kind.find_left(session);
  RunRecorder recorder(session.folder, num_workers, observer);
  SealStore(kSessionStore, session.folder);
  const bool is_complete = RunBatch(
      MakeRoundStage(kind, session, trials.size()), trials, num_workers,
      kind.make_workers(session, prepared.inputs, session.folder, ""), recorder, trial_time_limit);
  SealStore(kSessionStore, session.folder);
  if (trials.empty()) return {{}, 0.0, num_workers, 0, RunEnding::kFinished};
  return recorder.Keep(is_complete);
}

PreparedSession LoadFinished(const fs::path& folder, OnDamage on_damage) {
  PreparedSession finished;
  finished.session = LoadSession(folder, on_damage, RecordParts::kBrief);
  const Session& session = finished.session;
  finished.inputs = LoadSessionInputs(session.config, FieldUse::kLater, folder);
  CheckSameSession(session, session.config, MakePlan(session.config, finished.inputs));
  return finished;
}

JudgeRound JudgeSession(const fs::path& folder, int num_workers, Observer& observer,
                        OnDamage on_damage, double trial_time_limit) {
  const PreparedSession finished = LoadFinished(folder, on_damage);
  JudgeRound round;
  for (const PlannedTrial& trial : FindUnjudged(finished.session)) round.asked.insert(trial.id);
  round.is_complete =
      RunRound(kJudgeRound, finished, num_workers, observer, trial_time_limit).ending ==
      RunEnding::kFinished;
  return round;
}

bool ExplainSession(const fs::path& folder, const RoundKind& kind, int num_workers,
                    Observer& observer, OnDamage on_damage, double trial_time_limit) {
  return RunRound(kind, LoadFinished(folder, on_damage), num_workers, observer, trial_time_limit)
             .ending == RunEnding::kFinished;
}

}  // namespace graspbench
