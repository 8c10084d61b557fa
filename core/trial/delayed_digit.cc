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
  return DelayDigit(std::move(setup), index, delay);
}

TrialSetup DelayDigit(TrialSetup setup, int digit, double delay) {
  GRASPBENCH_DEMAND(delay >= 0.0, std::to_string(delay));
  setup.lateness.resize(setup.hand->digits.size(), 0.0);
  setup.lateness[static_cast<size_t>(digit)] = delay;
  return setup;
}

}  // namespace graspbench
