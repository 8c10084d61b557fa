#include "datasets/plan/grip_check.h"

#include <fmt/core.h>

#include "core/base/error.h"
#include "core/trial/grip/grip_limit.h"

namespace graspbench {

void CheckGripForces(const SessionConfig& config, const SessionInputs& inputs) {
  const StrategyConfig& strategy = config.strategy;
  const GripMode mode = RowFromName(kGripModes, strategy.grip, "grip").value;
  if (mode == GripMode::kPosture) return;
  for (const SessionHand& hand : inputs.hands) {
    for (const Grasp& grasp : hand.grasps) {
      const double largest = CalcLargestGrip(*hand.hand, grasp);
      if (strategy.grip_force <= largest) continue;
      throw Error(ErrorKind::kRange,
                  fmt::format("strategy.grip_force_n: a digit of the hand \"{}\" cannot press with "
                              "{:.2f} N in the grasp {}; its drives give at most some {:.2f} N",
                              hand.hand->id, strategy.grip_force, grasp.id, largest));
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
