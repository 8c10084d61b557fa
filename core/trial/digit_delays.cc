#include "core/trial/digit_delays.h"

#include <algorithm>
#include <cmath>

#include "core/base/error.h"
#include "core/base/units.h"

namespace graspbench {
namespace {

constexpr int kMostTrials = 16;

using Times = std::map<std::string, double>;  // by digit [s]

}  // namespace

const DigitContact* FindLateDigit(const TrialResult& undelayed, LateDigit which) {
  const DigitContact* found = nullptr;
  int num_touched = 0;
  for (const DigitContact& contact : undelayed.contacts) {
    if (std::isnan(contact.time)) continue;
    ++num_touched;
    if (!found || (contact.time > found->time) == (which == LateDigit::kLast)) found = &contact;
  }
  const auto& snapshots = undelayed.snapshots;
  const bool has_begun_to_close = std::any_of(
      snapshots.begin(), snapshots.end(),
      [](const SceneSnapshot& snapshot) { return snapshot.moment == Moment::kPreGrasp; });
  return num_touched < 2 || !has_begun_to_close ? nullptr : found;
}

TrialSetup DelayLateDigit(TrialSetup setup, const TrialResult& undelayed) {
  const DigitContact* late = FindLateDigit(undelayed, setup.late);
  setup.late = LateDigit::kNone;
  if (!late) return setup;
  const std::vector<Digit>& digits = setup.hand->digits;
  const auto digit = std::find_if(digits.begin(), digits.end(), [late](const Digit& candidate) {
    return late->digit == candidate.id;
  });
  const double delay = setup.delay;
  return DelayDigit(std::move(setup), static_cast<int>(digit - digits.begin()), delay);
}

TrialSetup DelayDigit(TrialSetup setup, int digit, double delay) {
  GRASPBENCH_DEMAND(delay >= 0.0, std::to_string(delay));
  setup.lateness.resize(setup.hand->digits.size(), 0.0);
  setup.lateness[static_cast<size_t>(digit)] = delay;
  return setup;
}

std::map<std::string, ClosingSchedule> DelayBy(const std::map<std::string, double>& delays) {
  std::map<std::string, ClosingSchedule> closing;
  double least = HUGE_VAL;
  for (const auto& [digit, delay] : delays) least = std::min(least, delay);
  for (const auto& [digit, delay] : delays) {
    if (delay > least) closing[digit] = {delay - least, 1.0};
  }
  return closing;
}

LaggedClosing FitContactLags(TrialRunner& runner, TrialSetup setup, const Times& lags) {
  LaggedClosing best;
  best.largest_error = kUnset;
  Times best_delays, best_errors;
  for (const auto& [digit, lag] : lags) best_delays[digit] = best_errors[digit] = 0.0;
  double gain = 1.0;
  for (int trial = 0; trial < kMostTrials && !(best.largest_error <= setup.sim.step); ++trial) {
    Times delays = best_delays;
    for (auto& [digit, delay] : delays) delay += gain * best_errors[digit];
    setup.grasp.closing = DelayBy(delays);
    const TrialResult result = runner.Run(setup);
    double first = HUGE_VAL;
    bool all_touch = !result.contacts.empty();  // none: the simulation failed
    for (const DigitContact& contact : result.contacts) {
      if (std::isnan(contact.time)) {
        all_touch = false;
        if (trial == 0) best.untouching = contact.digit;
      } else {
        first = std::min(first, contact.time);
      }
    }
    if (!all_touch && trial == 0) return best;
    Times errors;
    double largest = 0.0;
    for (const DigitContact& contact : result.contacts) {
      errors[contact.digit] = lags.at(contact.digit) - (contact.time - first);
      largest = std::max(largest, std::abs(errors[contact.digit]));
    }
    // A late digit may push the object elsewhere; then a smaller correction is tried.
    if (all_touch && !(largest >= best.largest_error)) {
      best.closing = setup.grasp.closing;
      best.largest_error = largest;
      best_delays = delays;
      best_errors = errors;
      gain = 1.0;
    } else {
      gain *= 0.5;
    }
  }
  return best;
}

}  // namespace graspbench
