#include "workbench/experiments/grip_thresholds.h"

#include "datasets/analysis/conditions/threshold_summary.h"

namespace graspbench {
PreparedSession PrepareThresholds(const ExperimentRequest& request, const ThresholdScale& scale) {
  const Session session = LoadSession(request.folder, request.on_damage, RecordParts::kBrief);
  return PrepareExperiment(session, kThresholdKind, ListThresholdGrips(scale, session.config),
                           request);
}

bool RunThresholds(const PreparedSession& experiment, const ExperimentRequest& request,
                   int num_workers, Observer& observer, const std::atomic<bool>& stop) {
  Session session = experiment.session;
  while (!FindThresholdTrials(session).empty()) {
    if (RunRound(kThresholdRound, session, experiment.inputs, num_workers, observer, stop,
                 request.trial_time_limit)
            .ending != RunEnding::kFinished) {
      return false;
    }
    session = LoadSession(experiment.folder, request.on_damage, RecordParts::kBrief);
  }
  return true;
}

}  // namespace graspbench
