// The same trials in our engine and in MuJoCo: processor time of stepping per simulated second,
// creep during the hold and penetration side by side. Arguments: pairs of runs (default 10).
//   build/release/tests/bench/peer_mujoco
// Both sides run the same course of a trial (core/sim/trial_course.h) without variation and are
// judged by the same rules. Then the commands of that trial are repeated in a plain loop of steps,
// which is what is timed, ours and MuJoCo's in turns. What is equal and what is not:
// mujoco_world.h.

#include <mujoco/mujoco.h>
#include <time.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>
#include <vector>

#include "core/grasp/placement.h"
#include "core/hand/load_hand.h"
#include "core/sim/trial_course.h"
#include "objects/catalogue.h"
#include "tests/bench/mujoco_world.h"

namespace graspbench {
namespace {

struct Scene {
  const char* object;
  PrimitiveShape shape;
};
constexpr Scene kScenes[] = {{"tennis_ball", PrimitiveShape::kSphere},
                             {"golf_ball", PrimitiveShape::kSphere},
                             {"can", PrimitiveShape::kCylinder},
                             {"toy_cube", PrimitiveShape::kBox}};

/** A world that remembers how it was started and what it was asked for. */
template <class AnyWorld>
class Recorded : public AnyWorld {
 public:
  using AnyWorld::AnyWorld;
  void Reset(const WorldState& state) override {
    AnyWorld::Reset(state);
    start_ = state;
    commands_.clear();
  }
  StepReport Step(const WorldCommand& command) override {
    commands_.push_back(command);
    return AnyWorld::Step(command);
  }

  /** Processor time of the same steps once more [s]. */
  double Repeat() {
    AnyWorld::Reset(start_);
    const double start = ReadClock();
    for (const WorldCommand& command : commands_) AnyWorld::Step(command);
    return ReadClock() - start;
  }

 private:
  static double ReadClock() {
    timespec now;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
  }
  WorldState start_;
  std::vector<WorldCommand> commands_;
};

struct Side {
  std::string name;
  TrialResult result;
  std::vector<double> costs;   ///< processor time per simulated second
  std::vector<double> ratios;  ///< ours over this one, pair by pair
};

std::string FormatQuartiles(std::vector<double> values, double scale, int decimals) {
  std::sort(values.begin(), values.end());
  const auto at = [&](double share) {
    const double place = share * static_cast<double>(values.size() - 1);
    const auto low = static_cast<size_t>(place);
    const size_t high = std::min(low + 1, values.size() - 1);
    return scale *
           (values[low] + (place - static_cast<double>(low)) * (values[high] - values[low]));
  };
  char text[80];
  std::snprintf(text, sizeof text, "%.*f (%.*f to %.*f)", decimals, at(0.5), decimals, at(0.25),
                decimals, at(0.75));
  return text;
}

void RunScene(const std::shared_ptr<const Hand>& hand, const Scene& scene, int num_pairs) {
  TrialSetup setup;
  setup.hand = hand;
  setup.object = LoadObject(scene.object);
  const std::string grasp_id = setup.object->best_grasp.at(hand->id);
  for (const StandardGrasp& grasp : LoadStandardGrasps(*hand)) {
    if (grasp.id == grasp_id) setup.grasp = grasp;
  }
  setup.draw.joint_error = Eigen::VectorXd::Zero(hand->num_joints());
  const Placement placement =
      CalcPlacement(*hand, setup.grasp, setup.object->size, setup.object->mass_properties.p_OOcm);

  std::vector<MujocoConfig> configs(3);
  configs[1].step = 0.001;
  configs[2].noslip_iterations = 0;
  std::vector<Side> sides = {{"graspbench, 2 ms", {}, {}, {}},
                             {"MuJoCo, 2 ms", {}, {}, {}},
                             {"MuJoCo, 1 ms", {}, {}, {}},
                             {"MuJoCo, 2 ms, no noslip", {}, {}, {}}};
  Recorded<World> ours(*hand, *setup.object, setup.sim);
  sides[0].result = TrialCourse(ours, setup).Run();
  std::vector<std::unique_ptr<Recorded<MujocoWorld>>> peers;
  for (size_t i = 0; i < configs.size(); ++i) {
    TrialSetup peer_setup = setup;
    peer_setup.sim.step = configs[i].step;
    peers.push_back(std::make_unique<Recorded<MujocoWorld>>(
        *hand, *setup.object, scene.shape, peer_setup.sim, configs[i], placement.approach_W));
    sides[i + 1].result = TrialCourse(*peers[i], peer_setup).Run();
  }
  for (int pair = 0; pair < num_pairs; ++pair) {
    sides[0].costs.push_back(ours.Repeat() / sides[0].result.simulated_time);
    for (size_t i = 0; i < peers.size(); ++i) {
      Side& side = sides[i + 1];
      side.costs.push_back(peers[i]->Repeat() / side.result.simulated_time);
      side.ratios.push_back(sides[0].costs.back() / side.costs.back());
    }
  }

  std::printf("\n%s, %s, %s\n  %-24s %-21s %-20s %9s %7s %7s %7s\n", hand->name.c_str(),
              setup.object->name.c_str(), grasp_id.c_str(), "", "cost [ms/s]", "ratio", "creep",
              "depth", "deepest", "grip");
  for (const Side& side : sides) {
    const TrialResult& result = side.result;
    const bool is_held = result.outcome == Outcome::kSuccess;
    std::printf("  %-24s %-21s %-20s %9.5f %7.3f %7.3f %7.2f  %s%s%s\n", side.name.c_str(),
                FormatQuartiles(side.costs, 1e3, 1).c_str(),
                side.ratios.empty() ? "-" : FormatQuartiles(side.ratios, 1.0, 2).c_str(),
                1e3 * result.hold_creep, 1e3 * result.steady_penetration,
                1e3 * result.worst_penetration, result.grip_force,
                is_held ? "held" : "NOT HELD: ", is_held ? "" : NameOf(result.outcome),
                result.num_unconverged > 0 ? ", steps did not converge" : "");
  }
}

}  // namespace
}  // namespace graspbench

int main(int argc, char** argv) {
  using namespace graspbench;
  const int num_pairs = argc > 1 ? std::max(1, std::atoi(argv[1])) : 10;
  std::setvbuf(stdout, nullptr, _IOLBF, 0);  // a scene is shown when it is done
  const MujocoConfig config;
  std::printf(
      "MuJoCo %s: elliptic cones, impratio %.0f, solref %.3f s, solimp %.2f %.2f, Newton, %d "
      "noslip\n"
      "iterations, Euler with implicit damping. %d runs of each, in turns.\n"
      "cost: processor time per simulated second, median (quartiles); ratio: ours over MuJoCo's;\n"
      "creep [mm]: from 0.5 s after the lift to the end of the hold; depth [mm]: at the end of "
      "the\n"
      "hold; deepest [mm]: of the whole trial; grip [N]: sum of normal forces before the lift\n",
      mj_versionString(), config.impratio, config.time_constant, config.impedance_min,
      config.impedance_max, config.noslip_iterations, num_pairs);
  for (const char* hand_id : {"tum", "shadow"}) {
    const auto hand = std::make_shared<const Hand>(LoadHand(hand_id));
    for (const Scene& scene : kScenes) RunScene(hand, scene, num_pairs);
  }
}
