// Trials a second and time per step, for both hands on several objects, each checked to succeed as
// in a session; where the time of a step goes, on an object that is held; an instant
// of a trial saved and restored; a distance field built
// and read from the cache; positions and mass matrix of a hand, contracted and by Simbody's calcM.
//   build/release/tests/bench/sim_bench --validation workbench/manual/validation/speed.yaml

#include <benchmark/benchmark.h>
#include <malloc.h>
#include <unistd.h>

#include <algorithm>
#include <ctime>
#include <filesystem>
#include <string>

#include "core/base/text/text.h"
#include "core/hand/load_hand.h"
#include "core/physics/hand_dynamics.h"
#include "core/physics/implicit_world.h"
#include "core/physics/simbody/simbody_model.h"
#include "core/statistics/summary.h"
#include "core/trial/protocols/table_lift.h"
#include "core/trial/trial_runner.h"
#include "objects/catalogue.h"
#include "tests/bench/validation_main.h"

namespace graspbench {
namespace {

TrialSetup MakeSetup(const char* hand_id, const char* object_id, const char* grasp_id) {
  TrialSetup setup;
  setup.hand = std::make_shared<const Hand>(LoadHand(hand_id));
  setup.object = LoadObject(object_id);
  for (const Grasp& grasp : LoadStandardGrasps(*setup.hand)) {
    if (grasp.id == grasp_id) setup.grasp = grasp;
  }
  setup.draw.joint_error = Eigen::VectorXd::Zero(setup.hand->num_joints());
  return setup;
}

void BM_Trial(benchmark::State& state, const char* hand_id, const char* object_id,
              const char* grasp_id) {
  const TrialSetup setup = MakeSetup(hand_id, object_id, grasp_id);
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

/** One trial of every object with its best grasp: the median of the objects' processor times. A
trial without variation lasts as long as one with it. */
void BM_MedianTrial(benchmark::State& state, const char* hand_id) {
  std::vector<TrialSetup> setups;
  std::vector<std::unique_ptr<TrialRunner>> runners;
  for (const std::string& id : ListObjects()) {
    const std::shared_ptr<const GraspObject> object = LoadObject(id);
    const auto best = object->best_grasp.find(hand_id);
    if (best == object->best_grasp.end()) continue;
    setups.push_back(MakeSetup(hand_id, id.c_str(), best->second.c_str()));
    runners.push_back(std::make_unique<TrialRunner>(setups.back().hand, setups.back().object));
  }
  std::vector<std::vector<double>> times(setups.size());
  std::vector<Outcome> outcomes(setups.size());
  for (auto _ : state) {
    for (size_t i = 0; i < setups.size(); ++i) {
      const std::clock_t start = std::clock();
      outcomes[i] = runners[i]->Run(setups[i]).outcome;
      times[i].push_back(static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
    }
  }
  const auto held = std::count(outcomes.begin(), outcomes.end(), Outcome::kSuccess);
  if (2 * held < static_cast<long>(outcomes.size())) state.SkipWithError("most were not held");
  std::vector<double> medians;
  for (const std::vector<double>& cell : times) medians.push_back(CalcMedian(cell));
  state.counters["objects"] = static_cast<double>(setups.size());
  state.counters["median_trial_ms"] = 1e3 * CalcMedian(medians);
  state.counters["slowest_ms"] = 1e3 * *std::max_element(medians.begin(), medians.end());
}
BENCHMARK_CAPTURE(BM_MedianTrial, tum, "tum-evolved")->Unit(benchmark::kMillisecond)->Iterations(5);
BENCHMARK_CAPTURE(BM_MedianTrial, shadow, "shadow-evolved")
    ->Unit(benchmark::kMillisecond)
    ->Iterations(5);

enum class StepPart { kWhole, kKinematics, kMassMatrix, kBias, kCollision };

/** One part of a step at the end of a trial, the object held. What the parts leave of the whole is
the solve, the account of energy and the report. */
void BM_Step(benchmark::State& state, const char* hand_id, const char* object_id,
             const char* grasp_id, StepPart part) {
  const TrialSetup setup = MakeSetup(hand_id, object_id, grasp_id);
  TableLift course(std::make_unique<ImplicitWorld>(*setup.hand, *setup.object, setup.sim), setup);
  World& world = course.world();
  if (course.Run().outcome != Outcome::kSuccess) state.SkipWithError("the object is not held");
  WorldCommand command = course.last_command();
  command.num_steps = 1;
  const WorldState held = world.state();
  HandDynamics& dynamics = world.dynamics();
  Collider collider(*setup.hand, *setup.object, setup.sim, TablePresence::kPresent);
  std::vector<ContactPoint> contacts;
  Eigen::MatrixXd M(dynamics.num_speeds(), dynamics.num_speeds());
  Eigen::VectorXd bias(dynamics.num_speeds());
  const Eigen::VectorXd hand_speeds = world.CalcHandSpeeds();
  int step = 0;
  for (auto _ : state) {
    switch (part) {
      case StepPart::kWhole:
        benchmark::DoNotOptimize(world.Step(command).grip_force);
        break;
      case StepPart::kKinematics:
        dynamics.UpdatePositions(held.X_WH, held.q);
        break;
      case StepPart::kMassMatrix:
        dynamics.CalcMassMatrix(M);
        break;
      case StepPart::kBias:
        dynamics.CalcBias(hand_speeds, held.gravity_W, bias);
        break;
      case StepPart::kCollision:
        collider.FindContacts(dynamics, world.CalcObjectPose(), held.p_WOcm, step++, contacts);
        break;
    }
  }
  if (part == StepPart::kWhole && world.Step(command).grip_force <= 0.0) {
    state.SkipWithError("the object was lost");
  }
  if (part == StepPart::kCollision && contacts.empty()) state.SkipWithError("no contact");
}
BENCHMARK_CAPTURE(BM_Step, tum_can_whole, "tum", "can", "g3", StepPart::kWhole);
BENCHMARK_CAPTURE(BM_Step, tum_can_kinematics, "tum", "can", "g3", StepPart::kKinematics);
BENCHMARK_CAPTURE(BM_Step, tum_can_mass_matrix, "tum", "can", "g3", StepPart::kMassMatrix);
BENCHMARK_CAPTURE(BM_Step, tum_can_bias, "tum", "can", "g3", StepPart::kBias);
BENCHMARK_CAPTURE(BM_Step, tum_can_collision, "tum", "can", "g3", StepPart::kCollision);
BENCHMARK_CAPTURE(BM_Step, shadow_can_whole, "shadow", "can", "g3", StepPart::kWhole);
BENCHMARK_CAPTURE(BM_Step, shadow_can_kinematics, "shadow", "can", "g3", StepPart::kKinematics);
BENCHMARK_CAPTURE(BM_Step, shadow_can_mass_matrix, "shadow", "can", "g3", StepPart::kMassMatrix);
BENCHMARK_CAPTURE(BM_Step, shadow_can_bias, "shadow", "can", "g3", StepPart::kBias);
BENCHMARK_CAPTURE(BM_Step, shadow_can_collision, "shadow", "can", "g3", StepPart::kCollision);

/** Saving an instant in the middle of the hold, or restoring it; `kilobytes` of heap for each. */
void BM_Instant(benchmark::State& state, const char* hand_id, bool restores) {
  const TrialSetup setup = MakeSetup(hand_id, "can", "g3");
  TableLift course(std::make_unique<ImplicitWorld>(*setup.hand, *setup.object, setup.sim), setup);
  course.Begin();
  while (course.time() < 3.0 && course.Advance()) {
  }
  const TrialInstant instant = course.Save();
  const size_t before = mallinfo2().uordblks;
  TrialInstant saved = course.Save();
  state.counters["kilobytes"] = static_cast<double>(mallinfo2().uordblks - before) / 1e3;
  for (auto _ : state) {
    if (restores) {
      course.Restore(instant);
    } else {
      saved = course.Save();
    }
  }
  TableLift whole(std::make_unique<ImplicitWorld>(*setup.hand, *setup.object, setup.sim), setup);
  const std::string expected = ToJson(whole.Run()).dump();
  course.Restore(saved);
  while (course.Advance()) {
  }
  if (ToJson(course.End()).dump() != expected) state.SkipWithError("the restored trial differs");
}
BENCHMARK_CAPTURE(BM_Instant, tum_save, "tum", false)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(BM_Instant, tum_restore, "tum", true)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(BM_Instant, shadow_save, "shadow", false)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(BM_Instant, shadow_restore, "shadow", true)->Unit(benchmark::kMicrosecond);

/** The distance field of an object, built (cold) or read from the cache (warm). */
void BM_Field(benchmark::State& state, const char* object_id, bool is_warm) {
  const std::shared_ptr<const GraspObject> object = LoadObject(object_id);
  const std::filesystem::path cache =
      std::filesystem::temp_directory_path() / ("graspbench_bench_" + std::to_string(::getpid()));
  if (is_warm) SignedDistanceField::LoadOrBuild(object->mesh, cache);
  double distance = 0.0;
  for (auto _ : state) {
    distance = (is_warm ? *SignedDistanceField::LoadOrBuild(object->mesh, cache)
                        : SignedDistanceField::Build(object->mesh))
                   .Query(Eigen::Vector3d::Zero())
                   .distance;
  }
  std::filesystem::remove_all(cache);
  if (distance != object->field->Query(Eigen::Vector3d::Zero()).distance) {
    state.SkipWithError("the fields differ");
  }
}
BENCHMARK_CAPTURE(BM_Field, can_cold, "can", false)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(BM_Field, can_warm, "can", true)->Unit(benchmark::kMillisecond);

void BM_HandMass(benchmark::State& state, const char* hand_id, bool is_whole) {
  Hand hand = LoadHand(hand_id);
  for (HandJoint& joint : hand.joints) joint.coupled_to = -1;  // SimbodyModel ties nothing
  MassProperties object;
  object.mass = 0.1;
  object.I_OOcm = 1e-4 * Eigen::Matrix3d::Identity();
  SimbodyModel simbody(hand, object);
  HandDynamics dynamics(hand);
  const int speeds = dynamics.num_speeds();
  Eigen::VectorXd q = Eigen::VectorXd::Zero(hand.num_joints());
  Eigen::MatrixXd M(speeds, speeds), M_simbody;
  const auto calc_whole = [&] {
    simbody.SetPositions(Pose::Identity(), q, Pose::Identity());
    M_simbody = simbody.CalcMassMatrix();
  };
  const auto contract = [&] {
    dynamics.UpdatePositions(Pose::Identity(), q);
    dynamics.CalcMassMatrix(M);
  };
  double angle = 0.0;
  for (auto _ : state) {
    q.setConstant(angle += 1e-6);
    is_whole ? calc_whole() : contract();
  }
  calc_whole();
  contract();
  if ((M - M_simbody.topLeftCorner(speeds, speeds)).cwiseAbs().maxCoeff() > 1e-11) {
    state.SkipWithError("the mass matrices differ");
  }
}
BENCHMARK_CAPTURE(BM_HandMass, tum_contracted, "tum", false);
BENCHMARK_CAPTURE(BM_HandMass, tum_calcM, "tum", true);
BENCHMARK_CAPTURE(BM_HandMass, shadow_contracted, "shadow", false);
BENCHMARK_CAPTURE(BM_HandMass, shadow_calcM, "shadow", true);

struct MedianTrialBar {
  const char* run;
  const char* hand;
  double milliseconds;
};
constexpr MedianTrialBar kMedianTrialBars[] = {{"BM_MedianTrial/tum", "TUM", 30.0},
                                               {"BM_MedianTrial/shadow", "Shadow", 50.0}};

std::vector<ValidationRow> MakeRows(const BenchmarkRuns& all) {
  std::vector<ValidationRow> rows;
  for (const MedianTrialBar& bar : kMedianTrialBars) {
    const auto runs = all.by_name.find(bar.run);
    if (runs == all.by_name.end()) continue;
    const std::vector<double>& times = runs->second.counters.at("median_trial_ms");
    ValidationRow row = MakeValidationRow("Speed", true);
    row.claim = std::string("a trial of the ") + bar.hand +
                " Hand with the best grasp, processor time, median of the 21 objects";
    row.command = "build/release/tests/bench/sim_bench --benchmark_filter=MedianTrial";
    SetFigure(row, times, " ms");
    row.bar = FormatSignificant(bar.milliseconds, 3) + " ms";
    row.met = CalcMedian(times) <= bar.milliseconds ? "yes" : "no";
    rows.push_back(row);
  }
  return rows;
}

}  // namespace
}  // namespace graspbench

int main(int argc, char** argv) {
  return graspbench::RunBenchmarks(argc, argv, graspbench::MakeRows);
}
