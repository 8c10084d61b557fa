#include "core/trial/trial_outcome.h"

#include <fmt/core.h>

#include <cmath>

#include "core/base/units.h"

namespace graspbench {
namespace {

// Proposed by graspbench (method: the object has left the table, stays in the hand, is slower than
// 5 mm/s relative to the palm at the end).
constexpr double kLiftedShare = 0.5;  ///< of the lift height
constexpr double kPushedAway = 0.05;  ///< horizontal displacement of a free object [m]
constexpr double kTippedShare = 0.1;  ///< change of the height of an object that lies anew

/** A trial is given up after this long without the solver converging [s]. */
constexpr double kMaxUnconvergedTime = 0.1;
/** The object counts as lost when the hand has not touched it for this long [s]. */
constexpr double kLostTime = 0.15;

}  // namespace

bool IsHeld(const TrialFacts& facts) {
  return facts.grip_force > 0.0 && facts.table_force == 0.0 &&
         facts.rise > kLiftedShare * facts.lift_distance;
}

bool IsDecided(const TrialFacts& facts) {
  if (!facts.is_finite || facts.unconverged_time > kMaxUnconvergedTime) return true;
  const bool is_free = facts.time - facts.last_touch > kLostTime;
  switch (facts.phase) {
    case Phase::kPlacing:
    case Phase::kClosure:
    case Phase::kStabilisation:
      return is_free && facts.displacement > kPushedAway;
    case Phase::kLiftOff:
      return is_free && facts.table_force > 0.0 && facts.time_in_phase > 0.5 * facts.lift_time;
    case Phase::kHold:
      return is_free;
    case Phase::kPreGrasp:
    case Phase::kDone:
      break;
  }
  return false;
}

OutcomeReason FindOutcome(const TrialFacts& facts) {
  if (!facts.is_finite) {
    return {Outcome::kNumericalFailure,
            fmt::format("positions or speeds became infinite {:.3f} s into the trial", facts.time)};
  }
  if (facts.unconverged_time > kMaxUnconvergedTime) {
    return {Outcome::kNumericalFailure,
            fmt::format("the solver did not converge for {:.2f} s, up to {:.3f} s into the trial",
                        facts.unconverged_time, facts.time)};
  }
  if (facts.phase < Phase::kLiftOff) {
    return {Outcome::kPushedAway,
            fmt::format("the object was pushed {:.0f} mm aside before it was held",
                        MmFromM(facts.displacement))};
  }
  const bool was_lifted = facts.phase == Phase::kHold || facts.phase == Phase::kDone;
  if (IsHeld(facts)) {
    if (facts.phase == Phase::kDone && facts.relative_speed <= kSteadySpeed) {
      return {Outcome::kSuccess, ""};
    }
    return {Outcome::kDroppedWhileHolding,
            fmt::format("still moving in the hand at {:.1f} mm/s at the end of the hold",
                        MmFromM(facts.relative_speed))};
  }
  if (was_lifted && facts.rise < kLiftedShare * facts.lift_distance &&
      facts.last_touch > facts.time - facts.time_in_phase) {
    return {Outcome::kDroppedWhileHolding,
            fmt::format("fell out of the hand {:.2f} s into the hold", facts.time_in_phase)};
  }
  if (std::abs(facts.extent - facts.rest_extent) > kTippedShare * facts.rest_extent) {
    return {Outcome::kKnockedOver, "the object tipped over and stayed behind"};
  }
  int num_touched = 0;
  std::string untouched;
  for (const DigitContact& contact : facts.contacts) {
    if (!std::isnan(contact.time)) {
      ++num_touched;
    } else {
      untouched += (untouched.empty() ? "" : ", ") + contact.digit;
    }
  }
  if (num_touched < 2) return {Outcome::kNoContact, "never touched by " + untouched};
  if (facts.displacement > kPushedAway) {
    return {Outcome::kPushedAway,
            fmt::format("the object was pushed {:.0f} mm aside and stayed behind",
                        MmFromM(facts.displacement))};
  }
  if (!untouched.empty()) return {Outcome::kNoContact, "never touched by " + untouched};
  if (facts.closed_grip_force == 0.0) {
    return {Outcome::kLostWhileClosing, "all digits had touched, but none did before lift-off"};
  }
  return {
      Outcome::kSlippedInLiftOff,
      fmt::format("gripped with {:.2f} N in all, but it stayed behind", facts.closed_grip_force)};
}

}  // namespace graspbench
