#include "core/trial/delayed_digit.h"

#include <algorithm>
#include <cmath>

#include "core/base/error.h"

namespace graspbench {
namespace {

/** NaN when it was not reached. */
double FindClosureStart(const TrialResult& result) {
  for (const SceneSnapshot& snapshot : result.snapshots) {
    if (snapshot.moment == Moment::kPreGrasp) return snapshot.time;
  }
  return kUnset;
}

}  // namespace

std::string FindLateDigit(const TrialResult& undelayed, LateDigit which) {
  const DigitContact* found = nullptr;
  int num_touched = 0;
  for (const DigitContact& contact : undelayed.contacts) {
    if (std::isnan(contact.time)) continue;
    ++num_touched;
    if (!found || (contact.time > found->time) == (which == LateDigit::kLast)) found = &contact;
  }
  if (num_touched < 2 || std::isnan(FindClosureStart(undelayed))) return "";
  return std::string(found->digit);
}

TrialSetup DelayLateDigit(TrialSetup setup, const TrialResult& undelayed) {
  const std::string id = FindLateDigit(undelayed, setup.late);
  const double delay = setup.delay;
  setup.late = LateDigit::kNone;
  if (id.empty()) return setup;
  const std::vector<Digit>& digits = setup.hand->digits;
  const auto digit = std::find_if(digits.begin(), digits.end(),
                                  [&id](const Digit& candidate) { return candidate.id == id; });
  const int index = static_cast<int>(digit - digits.begin());
  return DelayDigit(std::move(setup), FindClosureStart(undelayed), index, delay);
}

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
