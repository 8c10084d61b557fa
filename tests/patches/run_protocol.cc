/** @file
Runs one trial by the protocol that protocol.patch adds, without gravity and with it: without, the
object waits where it is and can be grasped; with it and without a table it falls. */

#include <cstdio>

#include "core/grasp/standard_grasp.h"
#include "core/hand/load_hand.h"
#include "core/trial/trial_runner.h"
#include "objects/catalogue.h"

namespace {

using namespace graspbench;

TrialResult Run(double gravity) {
  TrialSetup setup;
  setup.hand = std::make_shared<const Hand>(LoadHand("tum"));
  setup.object = LoadObject("golf_ball", FieldUse::kNow);
  for (const Grasp& grasp : LoadStandardGrasps(*setup.hand)) {
    if (grasp.id == "g2") setup.grasp = grasp;
  }
  setup.draw.joint_error = Eigen::VectorXd::Zero(setup.hand->num_joints());
  setup.sim.gravity = gravity;
  setup.protocol = "air_lift";
  return TrialRunner(setup.hand, setup.object).Run(setup);
}

}  // namespace

int main() {
  const TrialResult floating = Run(0.0), falling = Run(kStandardGravity);
  for (const TrialResult& result : {floating, falling}) {
    std::printf("%s %s\n", NameOf(result.outcome), result.reason.c_str());
  }
  const auto touched = [](const TrialResult& result) {
    int count = 0;
    for (const DigitContact& contact : result.contacts) count += contact.time == contact.time;
    return count;
  };
  return touched(floating) >= 2 && touched(falling) == 0 ? 0 : 1;
}
