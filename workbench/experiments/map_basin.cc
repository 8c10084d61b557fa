#include "workbench/experiments/map_basin.h"

#include <memory>

#include "core/base/error.h"
#include "core/trial/trial_runner.h"
#include "datasets/plan/session_inputs.h"
#include "workbench/experiments/pool/batch_runner.h"

namespace graspbench {
namespace {

/** The trial without any variation. */
TrialSetup MakeNominalSetup(const BasinRequest& request) {
  SessionConfig config;
  config.hands = {request.hand};
  config.objects = {request.object};
  config.grasps = {request.grasp};
  config.trials = 1;
  const SessionInputs inputs = LoadSessionInputs(config);
  const std::vector<PlannedTrial> plan = MakePlan(config, inputs);
  if (plan.size() != 1) {
    throw Error(ErrorKind::kUsage, "found " + std::to_string(plan.size()) +
                                       " cells; a basin is that of one hand, one object and one "
                                       "grasp");
  }
  TrialSetup nominal = MakeTrialSetup(config, inputs, plan.front());
  nominal.draw = TrialDraw();
  nominal.draw.joint_error = Eigen::VectorXd::Zero(nominal.hand->num_joints());
  return nominal;
}

/** The n-th of the planned trials is the n-th sample. */
std::vector<PlannedTrial> PlanSamples(const TrialSetup& nominal, size_t num_samples) {
  std::vector<PlannedTrial> trials;
  for (size_t i = 0; i < num_samples; ++i) {
    trials.push_back({std::to_string(i), nominal.hand->id, nominal.object->id, nominal.grasp.id,
                      static_cast<int>(i)});
  }
  return trials;
}

}  // namespace

BasinMap MapBasin(const BasinRequest& request, int num_workers, Observer& observer,
                  const std::atomic<bool>& stop) {
  const TrialSetup nominal = MakeNominalSetup(request);
  BasinMap map;
  map.title = nominal.hand->name + ", " + nominal.object->name + ", " + nominal.grasp.id;
  map.samples = MakeBasinSamples(request.num_samples);
  const auto make_worker = [&](int) {
    const auto runner = std::make_shared<TrialRunner>(nominal.hand, nominal.object);
    return BatchWorker{[&, runner](const PlannedTrial& trial) {
                         const BasinSample& sample = map.samples[static_cast<size_t>(trial.trial)];
                         TrialSetup setup = nominal;
                         setup.draw.offset_x = sample.offset_x;
                         setup.draw.offset_y = sample.offset_y;
                         setup.draw.offset_yaw = sample.yaw;
                         return runner->Run(setup);
                       },
                       [&](const TrialRecord& record) {  // every sample belongs to one worker
                         BasinSample& sample = map.samples[static_cast<size_t>(record.plan.trial)];
                         sample.outcome = record.result.outcome;
                         sample.sigma = record.result.stability.sigma;
                       },
                       {},
                       [&, runner](const PlannedTrial&) { runner->Prepare(nominal.sim); }};
  };
  Stage stage;
  stage.kind = StageKind::kBasin;
  stage.num_all = stage.num_left = stage.num_trials = request.num_samples;
  if (!RunBatchStage(stage, PlanSamples(nominal, map.samples.size()), num_workers, make_worker,
                     observer, stop, request.trial_time_limit)) {
    throw Error(ErrorKind::kInterrupted, "stopped; nothing was written");
  }
  return map;
}

}  // namespace graspbench
