#include "core/trial/delayed_digit.h"

#include <algorithm>
#include <cmath>

#include "core/base/error.h"

namespace graspbench {

TrialSetup DelayDigit(TrialSetup setup, double closure_start, int digit, double delay) {
  GRASPBENCH_DEMAND(std::isfinite(closure_start) && delay >= 0.0 && setup.drives.empty(),
                    std::to_string(closure_start));
  const Hand& hand = *setup.hand;
  const std::vector<int> joints = FindDrivenJoints(hand, hand.digits[static_cast<size_t>(digit)]);
  const double step = setup.sim.step;
  const long num_waiting = std::lround(delay / step);
  double closing = 0.0;
  for (long k = 0; closing < 1.0; ++k) {
    // The sum of the strategy, term by term, so that no delay gives the very same trial.
    if (k > num_waiting) closing = std::min(1.0, closing + step / setup.strategy.closure_time);
    for (const int joint : joints) {
      const double pre = setup.grasp.q_pre[joint], target = setup.grasp.q_target[joint];
      setup.drives.push_back(
          {closure_start + static_cast<double>(k) * step, joint, pre + closing * (target - pre)});
    }
  }
  return setup;
}

}  // namespace graspbench
