#include "workbench/experiments/run_round.h"

#include "datasets/analysis/conditions/threshold_summary.h"
#include "datasets/session/judgement_store.h"
#include "datasets/shards/worker_log.h"
#include "workbench/experiments/pool/session_worker.h"

namespace graspbench {
namespace {

/** Trials go on where earlier runs ended. */
Stage MakeRoundStage(const RoundKind& kind, const Session& session, size_t num_left) {
  Stage stage = MakeStage(kind.stage, num_left);
  if (kind.find_left != FindUnfinished) return stage;
  stage.num_all = stage.num_trials = static_cast<int>(session.plan.size());
  for (const TrialRecord& finished : session.records) ++stage.before[finished.result.outcome];
  return stage;
}

}  // namespace

const RoundKind kTrialRound = {StageKind::kRun, "trial", "", FindUnfinished, MakeSessionWorkers};
const RoundKind kBenchmarkRound = {StageKind::kBenchmark, "trial", "", FindUnfinished,
                                   MakeSessionWorkers};
const RoundKind kJudgeRound = {StageKind::kJudge, "held grasp", kJudgeLabel, FindUnjudged,
                               MakeJudgeWorkers};
const RoundKind kThresholdRound = {StageKind::kRun, "trial", "", FindThresholdTrials,
                                   MakeSessionWorkers};

const RoundKind& FindTrialRound(const SessionConfig& config) {
  return FindThresholdScale(config) ? kThresholdRound : kTrialRound;
}

RunRecord RunRound(const RoundKind& kind, const Session& session, const SessionInputs& inputs,
                   int num_workers, Observer& observer, const std::atomic<bool>& stop,
                   double trial_time_limit) {
  const std::vector<PlannedTrial> trials = kind.find_left(session);
  RunRecorder recorder(session.folder, num_workers, observer);
  SealStore(kSessionStore, session.folder);
  const bool is_complete = RunBatchStage(
      MakeRoundStage(kind, session, trials.size()), trials, num_workers,
      kind.make_workers(session, inputs, session.folder, ""), recorder, stop, trial_time_limit);
  SealStore(kSessionStore, session.folder);
  if (trials.empty()) return {{}, 0.0, num_workers, 0, RunEnding::kFinished};
  return recorder.Keep(is_complete);
}

}  // namespace graspbench
