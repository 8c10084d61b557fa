#include "core/hand/coupling.h"

#include <algorithm>

#include "core/base/units.h"

namespace graspbench {
namespace {

// A middle joint this close to its upper limit is at its end; it must come back twice as far before
// it moves again, so that a springy limit does not make the mode flicker.
constexpr double kEndMargin = RadFromDeg(0.5);

}  // namespace

DistalRates CalcDistalRates(CouplingRule rule, double fixed_ratio, DistalMode mode) {
  switch (rule) {
    case CouplingRule::kEven:
      return {1.0, 1.0};
    case CouplingRule::kFixed:
      return {1.0, fixed_ratio};
    case CouplingRule::kMiddleFirst:
      break;
  }
  return mode == DistalMode::kMiddleMoves ? DistalRates{1.0, 0.0} : DistalRates{0.0, 1.0};
}

DistalMode FindDistalMode(double q_middle, double q_distal, double middle_upper, bool closing,
                          bool middle_is_blocked, DistalMode previous) {
  if (!closing) return q_distal > 0.0 ? DistalMode::kDistalMoves : DistalMode::kMiddleMoves;
  const double margin = previous == DistalMode::kDistalMoves ? 2.0 * kEndMargin : kEndMargin;
  const bool is_at_end = q_middle >= middle_upper - margin;
  const bool distal_may_close = q_distal < q_middle;
  return (middle_is_blocked || is_at_end) && distal_may_close ? DistalMode::kDistalMoves
                                                              : DistalMode::kMiddleMoves;
}

void ApplyCoupling(const Hand& hand, Eigen::VectorXd& q) {
  for (int j = 0; j < hand.num_joints(); ++j) {
    const HandJoint& joint = hand.joints[j];
    if (joint.coupled_to < 0) continue;
    if (joint.is_mimic) {
      q[j] = joint.mimic_offset + joint.mimic_ratio * q[joint.coupled_to];
      continue;
    }
    // Nothing touches, so under middle-first the distal joint has not begun to move.
    double distal = 0.0;
    if (hand.coupling != CouplingRule::kMiddleFirst) {
      const DistalRates rates =
          CalcDistalRates(hand.coupling, hand.fixed_coupling_ratio, DistalMode::kMiddleMoves);
      distal = rates.distal * q[joint.coupled_to];
    }
    q[j] = std::clamp(distal, joint.lower, joint.upper);
  }
}

}  // namespace graspbench
