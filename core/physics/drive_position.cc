#include "core/physics/drive_position.h"

namespace graspbench {

double CalcDrivePosition(const Hand& hand, const WorldState& state, int joint) {
  double position = state.q[joint];
  if (hand.coupling != CouplingRule::kMiddleFirst) return position;
  for (int other = 0; other < hand.num_joints(); ++other) {
    const HandJoint& coupled = hand.joints[static_cast<size_t>(other)];
    if (coupled.coupled_to != joint || coupled.is_mimic) continue;
    position += state.q[other] - (state.deviation.size() > 0 ? state.deviation[other] : 0.0);
  }
  return position;
}

}  // namespace graspbench
