#include "datasets/plan/grip_check.h"

#include <fmt/core.h>

#include <algorithm>

#include "core/base/error.h"
#include "core/trial/grip/grip_limit.h"
#include "datasets/plan/grasp_choice.h"

namespace graspbench {
namespace {

/** The grasps of the session that hold by the digits' pads, to which the estimate of a drive's
largest force belongs: a power grasp presses with links nearer to the palm, and more. */
std::vector<const Grasp*> ListUsed(const SessionConfig& config, const SessionInputs& inputs,
                                   const SessionHand& hand) {
  std::vector<const Grasp*> used;
  for (const auto& object : inputs.objects) {
    for (const Grasp* grasp : FindGrasps(config, inputs, hand, object)) {
      const bool is_known = std::find(used.begin(), used.end(), grasp) != used.end();
      if (grasp->type != GraspType::kPower && !is_known) used.push_back(grasp);
    }
  }
  return used;
}

}  // namespace

void CheckGripForces(const SessionConfig& config, const SessionInputs& inputs) {
  const StrategyConfig& strategy = config.strategy;
  const GripMode mode = RowFromName(kGripModes, strategy.grip, "grip").value;
  if (mode == GripMode::kPosture) return;
  for (const SessionHand& hand : inputs.hands) {
    for (const Grasp* grasp : ListUsed(config, inputs, hand)) {
      const double largest = CalcLargestGrip(*hand.hand, *grasp);
      if (strategy.grip_force <= largest) continue;
      throw Error(ErrorKind::kRange,
                  fmt::format("strategy.grip_force_n: a digit of the hand \"{}\" cannot press with "
                              "{:.2f} N in the grasp {}; its drives give at most some {:.2f} N",
                              hand.hand->id, strategy.grip_force, grasp->id, largest));
    }
  }
}

void CheckGripMargins(const SessionConfig& config, const SessionInputs& inputs) {
  const GripMode mode = RowFromName(kGripModes, config.strategy.grip, "grip").value;
  if (mode != GripMode::kMargin) return;
  for (const auto& object : inputs.objects) {
    if (object->surface.friction_dynamic > 0.0) continue;
    throw Error(
        ErrorKind::kRange,
        "strategy.grip: a margin needs friction, and the object \"" + object->id +
            "\" has none; give it some (object.yaml, model.friction_scale) or choose force");
  }
}

}  // namespace graspbench
