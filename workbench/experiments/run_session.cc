#include "workbench/experiments/run_session.h"

#include "core/base/hash.h"
#include "datasets/plan/input_copies.h"
#include "datasets/session/judgement_store.h"
#include "workbench/experiments/output_folder.h"
#include "workbench/experiments/pool/session_worker.h"

namespace graspbench {
namespace fs = std::filesystem;

namespace {

fs::path FindFolder(const SessionRequest& request, const std::vector<PlannedTrial>& plan) {
  if (!request.out.empty()) return request.out;
  std::string ids;
  for (const PlannedTrial& planned : plan) ids += planned.id;
  return fs::path("results") / (request.name + "-" + CalcHashHex(ids).substr(0, 8));
}

}  // namespace

PreparedSession PrepareSession(const SessionRequest& request) {
  PreparedSession prepared;
  const bool names_a_session = request.resume && !request.out.empty();
  if (names_a_session)
    prepared.session = LoadSession(request.out, request.on_damage, RecordParts::kBrief);
  if (request.config) {
    prepared.config = *request.config;
  } else if (names_a_session) {
    prepared.config = prepared.session.config;
  }
  // Whoever names the inputs again asks whether they are still the same.
  prepared.inputs = LoadSessionInputs(prepared.config, FieldUse::kLater,
                                      request.config ? fs::path() : prepared.session.folder);
  const std::vector<PlannedTrial> plan = MakePlan(prepared.config, prepared.inputs);
  prepared.folder = FindFolder(request, plan);
  const bool may_continue = request.resume || request.out.empty();
  if (!HasSession(prepared.folder)) {
    StagedFolder staged({prepared.folder, "", false, request.inputs});
    CopyInputs(prepared.config, staged.path());
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

Stage MakeSessionStage(StageKind kind, const Session& session, size_t num_unfinished) {
  Stage stage;
  stage.kind = kind;
  stage.num_all = stage.num_trials = static_cast<int>(session.plan.size());
  stage.num_left = static_cast<int>(num_unfinished);
  for (const TrialRecord& finished : session.records) ++stage.before[finished.result.outcome];
  return stage;
}

RunRecord RunSession(const PreparedSession& prepared, int num_workers, Observer& observer,
                     const std::atomic<bool>& stop, double trial_time_limit) {
  const std::vector<PlannedTrial> trials = FindUnfinished(prepared.session);
  const Stage stage = MakeSessionStage(StageKind::kRun, prepared.session, trials.size());
  RunRecorder recorder(prepared.folder, num_workers, observer);
  SealStore(kSessionStore, prepared.folder);
  const bool is_complete =
      RunBatchStage(stage, trials, num_workers,
                    MakeSessionWorkers(prepared.config, prepared.inputs, prepared.folder), recorder,
                    stop, trial_time_limit);
  SealStore(kSessionStore, prepared.folder);
  return recorder.Keep(is_complete);
}

bool JudgeSession(const fs::path& folder, int num_workers, Observer& observer,
                  const std::atomic<bool>& stop, OnDamage on_damage, double trial_time_limit) {
  const Session session = LoadSession(folder, on_damage, RecordParts::kBrief);
  const SessionInputs inputs = LoadSessionInputs(session.config, FieldUse::kLater, folder);
  CheckSameSession(session, session.config, MakePlan(session.config, inputs));
  return JudgeSession(session, inputs, folder, num_workers, observer, stop, trial_time_limit);
}

bool JudgeSession(const Session& session, const SessionInputs& inputs, const fs::path& folder,
                  int num_workers, Observer& observer, const std::atomic<bool>& stop,
                  double trial_time_limit) {
  const std::vector<PlannedTrial> trials = FindUnjudged(session);
  Stage stage;
  stage.kind = StageKind::kJudge;
  stage.num_all = stage.num_left = stage.num_trials = static_cast<int>(trials.size());
  SealStore(kSessionStore, folder);
  const bool is_complete =
      RunBatchStage(stage, trials, num_workers, MakeJudgeWorkers(session, inputs, folder), observer,
                    stop, trial_time_limit);
  SealStore(kSessionStore, folder);
  return is_complete;
}

}  // namespace graspbench
