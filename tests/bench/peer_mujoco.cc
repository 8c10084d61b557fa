// The same trials in our engine and in MuJoCo: processor time of stepping per simulated second,
// creep during the hold and penetration side by side. Arguments: pairs of runs (default 10).
//   build/release/tests/bench/peer_mujoco
// Both sides run the same course of a trial (core/trial/protocols/table_lift.h) without variation,
// with the grip of a session's default, and are judged by the same rules. Then the commands of that
// trial are repeated in a plain loop of steps, which is what is timed, ours and MuJoCo's in turns.
// What is equal and what is not: mujoco_world.h.

#include <mujoco/mujoco.h>
#include <time.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>
#include <type_traits>
#include <vector>

#include "core/base/text/text.h"
#include "core/grasp/placement.h"
#include "core/hand/load_hand.h"
#include "core/physics/implicit_world.h"
#include "core/statistics/summary.h"
#include "core/trial/protocols/table_lift.h"
#include "datasets/plan/session_config.h"
#include "objects/catalogue.h"
#include "tests/bench/mujoco_world.h"

namespace graspbench {
namespace {

struct PeerScene {
  const char* object;
  PrimitiveShape shape;
};
constexpr PeerScene kScenes[] = {{"tennis_ball", PrimitiveShape::kSphere},
                                 {"golf_ball", PrimitiveShape::kSphere},
                                 {"can", PrimitiveShape::kCylinder},
                                 {"toy_cube", PrimitiveShape::kBox}};

/** A world that remembers how it was started and what it was asked for; its clones do not. */
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
    const StepReport report = AnyWorld::Step(command);
    if constexpr (std::is_same_v<AnyWorld, MujocoWorld>) AnyWorld::UpdateDynamics();
    return report;
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
  std::vector<double> costs = {};   ///< processor time per simulated second
  std::vector<double> ratios = {};  ///< ours of the same step over this one, pair by pair
};

/** The benchmark's step, and that at which halving it flips no verdict of ours [s]. */
constexpr double kSteps[] = {0.002, 0.00025};

std::string FormatStep(double step) { return ", " + FormatSignificant(1e3 * step, 6) + " ms"; }

std::string FormatQuartiles(std::vector<double> values, double scale, int decimals) {
  for (double& value : values) value *= scale;
  const Answer<Summary> summary = CalcSummary(values);
  return FormatWithRange(summary->median, summary->lower_quartile, summary->upper_quartile,
                         decimals);
}

void RunScene(const std::shared_ptr<const Hand>& hand, const PeerScene& scene, int num_pairs) {
  TrialSetup setup;
  setup.hand = hand;
  setup.object = LoadObject(scene.object);
  const std::string grasp_id = setup.object->best_grasp.at(hand->id);
  for (const Grasp& grasp : LoadStandardGrasps(*hand)) {
    if (grasp.id == grasp_id) setup.grasp = grasp;
  }
  setup.strategy = MakePeopleGrip();
  setup.draw.joint_error = Eigen::VectorXd::Zero(hand->num_joints());
  const Placement placement = CalcPlacement(*hand, setup.grasp, *setup.object);

  std::vector<std::unique_ptr<TableLift>> courses;  // they own the worlds
  const auto run = [&](std::unique_ptr<World> world, const TrialSetup& own_setup) {
    courses.push_back(std::make_unique<TableLift>(std::move(world), own_setup));
    return courses.back()->Run();
  };
  std::vector<Recorded<ImplicitWorld>*> ours;
  std::vector<Side> sides;
  for (const double step : kSteps) {
    TrialSetup own_setup = setup;
    own_setup.sim.step = step;
    auto world = std::make_unique<Recorded<ImplicitWorld>>(*hand, *setup.object, own_setup.sim);
    ours.push_back(world.get());
    sides.push_back({"graspbench" + FormatStep(step), run(std::move(world), own_setup)});
  }
  std::vector<MujocoConfig> configs;
  for (const double step : kSteps) {
    MujocoConfig expert;
    expert.step = step;
    MujocoConfig alike = expert;  // our points of contact, and no slip
    alike.has_capsules_only = false;
    alike.noslip_iterations = 50;
    alike.noslip_tolerance = 0.0;
    configs.insert(configs.end(), {expert, alike});
  }
  std::vector<Recorded<MujocoWorld>*> peers;
  for (const MujocoConfig& config : configs) {
    TrialSetup peer_setup = setup;
    peer_setup.sim.step = config.step;
    peer_setup.sim.steady_step_factor = 1;
    auto world = std::make_unique<Recorded<MujocoWorld>>(
        *hand, *setup.object, scene.shape, peer_setup.sim, config, placement.approach_W);
    peers.push_back(world.get());
    sides.push_back(
        {"MuJoCo" + FormatStep(config.step) + (config.has_capsules_only ? ", expert" : ", alike"),
         run(std::move(world), peer_setup)});
  }
  for (int pair = 0; pair < num_pairs; ++pair) {
    for (size_t i = 0; i < ours.size(); ++i) {
      sides[i].costs.push_back(ours[i]->Repeat() / sides[i].result.simulated_time);
    }
    for (size_t i = 0; i < peers.size(); ++i) {
      Side& side = sides[ours.size() + i];
      const Side& own = sides[configs[i].step == kSteps[0] ? 0 : 1];
      side.costs.push_back(peers[i]->Repeat() / side.result.simulated_time);
      side.ratios.push_back(own.costs.back() / side.costs.back());
    }
  }

  std::printf("\n%s, %s, %s\n  %-27s %-24s %-20s %9s %7s %7s %7s\n", hand->name.c_str(),
              setup.object->name.c_str(), grasp_id.c_str(), "", "cost [ms/s]", "ratio", "creep",
              "depth", "deepest", "grip");
  for (const Side& side : sides) {
    const TrialResult& result = side.result;
    const bool is_held = result.outcome == Outcome::kSuccess;
    std::printf("  %-27s %-24s %-20s %9.5f %7.3f %7.3f %7.2f  %s%s%s\n", side.name.c_str(),
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
      "MuJoCo %s: elliptic cones, impratio %.0f, solref %.3f s, solimp %.2f %.2f, Newton,\n"
      "Euler with implicit damping; expert: capsules, 5 noslip iterations of default tolerance;\n"
      "alike: our contact balls, 50 noslip iterations to no tolerance. %d runs of each, in turns.\n"
      "cost: processor time per simulated second, median (quartiles); ratio: ours over MuJoCo's\n"
      "of the same step;\n"
      "creep [mm]: in the second half of the hold; depth [mm]: at the end of "
      "the\n"
      "hold; deepest [mm]: of the whole trial; grip [N]: sum of normal forces before the lift\n",
      mj_versionString(), config.impratio, config.time_constant, config.impedance_min,
      config.impedance_max, num_pairs);
  for (const char* hand_id : {"tum-evolved", "shadow-evolved"}) {
    const auto hand = std::make_shared<const Hand>(LoadHand(hand_id));
    for (const PeerScene& scene : kScenes) RunScene(hand, scene, num_pairs);
  }
}
