#include "workbench/experiments/grip_thresholds.h"

#include "datasets/analysis/conditions/threshold_summary.h"
#include "datasets/plan/grip_check.h"

namespace graspbench {
PreparedSession PrepareThresholds(const ExperimentRequest& request, const ThresholdScale& scale) {
  const Session session = LoadSession(request.folder, request.on_damage, RecordParts::kBrief);
  return PrepareExperiment(session, kThresholdKind, ListThresholdGrips(scale, session.config),
                           request);
}

std::vector<std::string> ListThresholdWarnings(const PreparedSession& experiment,
                                               const ThresholdScale& scale) {
  if (scale.mode != GripMode::kForce) return {};
  SessionConfig config = experiment.config;
  config.strategy.grip = RowOf(kGripModes, scale.mode).name;
  config.strategy.grip_force = scale.most;
  return ListGripWarnings(config, experiment.inputs);
}

}  // namespace graspbench
