#include "workbench/experiments/run_session.h"

#include "core/base/hash.h"
#include "datasets/plan/firm_grip.h"
#include "datasets/plan/input_copies.h"
#include "workbench/experiments/output_folder.h"

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
    DropUnusedGrip(prepared.config.strategy);
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

RunRecord RunSession(const PreparedSession& prepared, int num_workers, Observer& observer,
                     const std::atomic<bool>& stop, double trial_time_limit) {
  return RunRound(kTrialRound, prepared.session, prepared.inputs, num_workers, observer, stop,
                  trial_time_limit);
}

bool JudgeSession(const fs::path& folder, int num_workers, Observer& observer,
                  const std::atomic<bool>& stop, OnDamage on_damage, double trial_time_limit) {
  const Session session = LoadSession(folder, on_damage, RecordParts::kBrief);
  const SessionInputs inputs = LoadSessionInputs(session.config, FieldUse::kLater, folder);
  CheckSameSession(session, session.config, MakePlan(session.config, inputs));
  return RunRound(kJudgeRound, session, inputs, num_workers, observer, stop, trial_time_limit)
             .ending == RunEnding::kFinished;
}

}  // namespace graspbench
