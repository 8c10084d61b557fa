#include "core/trial/protocols/table_lift_outcome.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "core/base/units.h"

namespace graspbench {
namespace {

// Proposed by graspbench (method: the object has left the table, stays in the hand, is slower than
// 5 mm/s relative to the palm at the end).
constexpr double kLiftedShare = 0.5;  ///< of the lift height
constexpr double kPushedAway = 0.05;  ///< horizontal displacement of a free object [m]
constexpr double kTippedShare = 0.1;  ///< change of the height of an object that has fallen over

/** A trial is given up after this long without the solver converging [s]. */
constexpr double kMaxUnconvergedTime = 0.1;
// What no grasp of a real hand shows at the end of a hold.
constexpr double kDeepestContact = 0.001;     ///< [m]
constexpr double kUnexplainedEnergy = 0.001;  ///< of a whole trial [J]
constexpr double kShortestLever = 0.01;       ///< of a contact about a joint [m]

/** The object counts as lost when the hand has not touched it for this long [s]. */
constexpr double kLostTime = 0.15;

/** A torque that is cut at its limit may miss it by rounding. */
constexpr double kWholeTorque = 1.0 - 1e-9;

bool IsArmOverloaded(const TrialFacts& facts) {
  if (facts.arm_joint) return facts.report.arm_torque_share >= kWholeTorque;
  return facts.report.arm_force >= facts.arm_force_limit ||
         facts.report.arm_moment >= facts.arm_moment_limit;
}

bool IsUnreachable(const TrialFacts& facts) {
  return !facts.is_reachable || facts.start_gap < 0.0 || facts.arm_fault != ArmFault::kNone;
}

Outcome FindArmOutcome(ArmFault fault) {
  switch (fault) {
    case ArmFault::kNone:
      break;
    case ArmFault::kOutOfReach:
      return Outcome::kArmOutOfReach;
    case ArmFault::kNoStraightPath:
      return Outcome::kNoStraightPath;
    case ArmFault::kNearSingularity:
      return Outcome::kNearSingularity;
  }
  return Outcome::kNotRun;
}

/** Why a held object is not held as a real one would be; empty: it is. */
std::string FindImplausibility(const TrialFacts& facts) {
  if (facts.report.worst_penetration > kDeepestContact) {
    return fmt::format("the hand is {:.2f} mm inside the object (limit {:.0f} mm)",
                       MmFromM(facts.report.worst_penetration), MmFromM(kDeepestContact));
  }
  if (facts.report.worst_contact_force > facts.contact_force_limit) {
    return fmt::format("one contact presses with {:.0f} N; drives and arm can give {:.0f} N",
                       facts.report.worst_contact_force, facts.contact_force_limit);
  }
  if (std::abs(facts.energy_residual) > kUnexplainedEnergy) {
    return fmt::format("{:.2f} mJ of energy have no cause (limit {:.0f} mJ)",
                       1e3 * facts.energy_residual, 1e3 * kUnexplainedEnergy);
  }
  return "";
}

/** What ended the trial, whatever the hand holds; NotRun: nothing did. */
OutcomeReason FindBreakdown(const TrialFacts& facts) {
  if (!facts.not_seen.empty()) return {Outcome::kNotSeen, facts.not_seen};
  if (!facts.policy_fault.empty()) return {Outcome::kWrongAnswer, facts.policy_fault};
  if (!facts.is_reachable) {
    return {Outcome::kUnreachable,
            "the palm or another link would meet the object before the fingertips hold it"};
  }
  if (facts.start_gap < 0.0) {
    return {Outcome::kUnreachable, fmt::format("the hand would start {:.1f} mm inside the object",
                                               MmFromM(-facts.start_gap))};
  }
  if (facts.arm_fault != ArmFault::kNone) {
    return {FindArmOutcome(facts.arm_fault), facts.arm_reason};
  }
  if (!facts.report.is_finite) {
    return {Outcome::kNumericalFailure,
            fmt::format("positions or speeds became infinite {:.3f} s into the trial", facts.time)};
  }
  if (facts.unconverged_time > kMaxUnconvergedTime) {
    return {Outcome::kNumericalFailure,
            fmt::format("the solver did not converge for {:.2f} s, up to {:.3f} s into the trial",
                        facts.unconverged_time, facts.time)};
  }
  if (IsArmOverloaded(facts) && facts.arm_joint) {
    return {Outcome::kArmOverloaded,
            fmt::format("joint \"{}\" of the arm is at its limit of {:.1f} N m, with the weight "
                        "that it holds; the hand bears {:.0f} N and {:.1f} N m besides",
                        facts.arm_joint->name, facts.arm_joint->torque, facts.report.arm_force,
                        facts.report.arm_moment)};
  }
  if (IsArmOverloaded(facts)) {
    return {
        Outcome::kArmOverloaded,
        fmt::format("the arm bore {:.0f} N and {:.1f} N m in addition to the hand's weight (limits "
                    "{:.0f} N, {:.1f} N m)",
                    facts.report.arm_force, facts.report.arm_moment, facts.arm_force_limit,
                    facts.arm_moment_limit)};
  }
  return {Outcome::kNotRun, ""};
}

/** Whether an object is up in the hand, whatever bears it; only on the table it "stayed behind". */
bool IsUp(const TrialFacts& facts) {
  return facts.report.grip_force > 0.0 && facts.rise > kLiftedShare * facts.lift_distance;
}

std::string DescribeEnd(const TrialFacts& facts) {
  if (!IsUp(facts)) return "stayed behind";
  return fmt::format("hangs in the hand {:.0f} mm up and still touches the table",
                     MmFromM(facts.rise));
}

/** Why an object was not lifted off the table that did not tip over. */
OutcomeReason FindLoss(const TrialFacts& facts) {
  int num_touched = 0;
  std::string untouched;
  for (const DigitContact& contact : facts.contacts) {
    if (!std::isnan(contact.time)) {
      ++num_touched;
    } else {
      untouched += (untouched.empty() ? "" : ", ") + contact.digit.str();
    }
  }
  if (num_touched < 2) return {Outcome::kNoContact, "not touched while closing by " + untouched};
  if (facts.displacement > kPushedAway) {
    return {Outcome::kPushedAway, fmt::format("the object was pushed {:.0f} mm aside and {}",
                                              MmFromM(facts.displacement), DescribeEnd(facts))};
  }
  if (!untouched.empty()) return {Outcome::kNoContact, "not touched while closing by " + untouched};
  if (facts.closed_grip_force == 0.0) {
    return {Outcome::kLostWhileClosing, "all digits had touched, but none did before lift-off"};
  }
  return {Outcome::kSlippedInLiftOff, fmt::format("gripped with {:.2f} N in all, but it {}",
                                                  facts.closed_grip_force, DescribeEnd(facts))};
}

}  // namespace

double CalcContactForceLimit(const Hand& hand, double arm_force_limit) {
  double torque = 0.0;
  for (const HandJoint& joint : hand.joints) torque = std::max(torque, joint.drive.torque_limit);
  return arm_force_limit + torque / kShortestLever;
}

bool IsHeld(const TrialFacts& facts) { return IsUp(facts) && facts.report.table_force == 0.0; }

bool IsDecided(const TrialFacts& facts) {
  if (!facts.report.is_finite || facts.unconverged_time > kMaxUnconvergedTime) return true;
  if (!facts.not_seen.empty() || !facts.policy_fault.empty() || IsUnreachable(facts) ||
      IsArmOverloaded(facts))
    return true;
  const bool is_free = facts.time - facts.last_touch > kLostTime;
  switch (facts.phase) {
    case Phase::kPlacing:
    case Phase::kClosure:
    case Phase::kStabilisation:
      return is_free && facts.displacement > kPushedAway;
    case Phase::kLiftOff:
      return is_free && facts.report.table_force > 0.0 &&
             facts.time_in_phase > 0.5 * facts.lift_time;
    case Phase::kHold:
      return is_free;
    case Phase::kPreGrasp:
    case Phase::kDone:
      break;
  }
  return false;
}

OutcomeReason FindOutcome(const TrialFacts& facts) {
  OutcomeReason breakdown = FindBreakdown(facts);
  if (breakdown.outcome != Outcome::kNotRun) return breakdown;
  if (facts.phase < Phase::kLiftOff) {
    return {Outcome::kPushedAway,
            fmt::format("the object was pushed {:.0f} mm aside before it was held",
                        MmFromM(facts.displacement))};
  }
  const bool was_lifted = facts.phase == Phase::kHold || facts.phase == Phase::kDone;
  if (IsHeld(facts)) {
    if (facts.phase == Phase::kDone && facts.relative_speed <= kSteadySpeed) {
      const std::string implausibility = FindImplausibility(facts);
      if (!implausibility.empty()) return {Outcome::kNotPhysical, implausibility};
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
    return {Outcome::kKnockedOver,
            (IsUp(facts) ? "the object tilted and " : "the object tipped over and ") +
                DescribeEnd(facts)};
  }
  return FindLoss(facts);
}

}  // namespace graspbench
