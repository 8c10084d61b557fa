// Trials a second and time per step, for both hands on several objects, each checked to succeed as
// in a session; beside them what Simbody's own position kinematics would cost per step.
//   build/release/tests/bench/sim_bench

#include <benchmark/benchmark.h>

#include <algorithm>
#include <string>

#include "core/hand/load_hand.h"
#include "core/sim/hand_dynamics.h"
#include "core/sim/simbody_model.h"
#include "core/sim/trial.h"
#include "objects/catalogue.h"

namespace graspbench {
namespace {

void BM_Trial(benchmark::State& state, const char* hand_id, const char* object_id,
              const char* grasp_id) {
  TrialSetup setup;
  setup.hand = std::make_shared<const Hand>(LoadHand(hand_id));
  setup.object = LoadObject(object_id);
  for (const StandardGrasp& grasp : LoadStandardGrasps(*setup.hand)) {
    if (grasp.id == grasp_id) setup.grasp = grasp;
  }
  setup.draw.joint_error = Eigen::VectorXd::Zero(setup.hand->num_joints());
  TrialRunner runner(setup.hand, setup.object);
  TrialResult result;
  int64_t num_steps = 0;
  for (auto _ : state) {
    result = runner.Run(setup);
    num_steps += result.num_steps;
  }
  if (result.outcome != Outcome::kSuccess) state.SkipWithError(result.reason.c_str());
  state.counters["steps_per_s"] =
      benchmark::Counter(static_cast<double>(num_steps), benchmark::Counter::kIsRate);
  state.counters["trials_per_s"] =
      benchmark::Counter(static_cast<double>(state.iterations()), benchmark::Counter::kIsRate);
}
BENCHMARK_CAPTURE(BM_Trial, tum_cube, "tum", "toy_cube", "g2")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(BM_Trial, tum_remote, "tum", "remote_control", "g1")
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(BM_Trial, tum_ball, "tum", "tennis_ball", "g3")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(BM_Trial, shadow_cube, "shadow", "toy_cube", "g2")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(BM_Trial, shadow_remote, "shadow", "remote_control", "g1")
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(BM_Trial, shadow_ball, "shadow", "tennis_ball", "g3")
    ->Unit(benchmark::kMillisecond);

void BM_Positions(benchmark::State& state, const char* hand_id, bool by_simbody) {
  const Hand hand = LoadHand(hand_id);
  MassProperties object;
  object.mass = 0.1;
  object.I_OOcm = 1e-4 * Eigen::Matrix3d::Identity();
  SimbodyModel simbody(hand, object);
  HandDynamics dynamics(hand);
  Eigen::VectorXd q = Eigen::VectorXd::Zero(hand.num_joints());
  std::vector<Pose> X_WL;
  double angle = 0.0;
  for (auto _ : state) {
    q.setConstant(angle += 1e-6);
    if (by_simbody) {
      simbody.SetPositions(Pose::Identity(), q, Pose::Identity());
      simbody.CalcLinkPoses(X_WL);
    } else {
      dynamics.UpdatePositions(Pose::Identity(), q);
    }
  }
  simbody.SetPositions(Pose::Identity(), q, Pose::Identity());
  simbody.CalcLinkPoses(X_WL);
  dynamics.UpdatePositions(Pose::Identity(), q);
  const int last = static_cast<int>(hand.links.size()) - 1;
  if (!X_WL[last].isApprox(dynamics.X_WL(last), 1e-12)) state.SkipWithError("the poses differ");
}
BENCHMARK_CAPTURE(BM_Positions, tum_ours, "tum", false);
BENCHMARK_CAPTURE(BM_Positions, tum_simbody, "tum", true);
BENCHMARK_CAPTURE(BM_Positions, shadow_ours, "shadow", false);
BENCHMARK_CAPTURE(BM_Positions, shadow_simbody, "shadow", true);

}  // namespace
}  // namespace graspbench
