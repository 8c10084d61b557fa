#pragma once
/** @file
What a trial is called in the end: one table, in which every rule that depends on the outcome
stands. A new outcome is a value, a row, and its condition in protocols/table_lift_outcome.cc. */

#include <string>
#include <vector>

#include "core/base/enum_table.h"
#include "core/base/text/json.h"

namespace graspbench {

enum class Outcome {
  kNotRun,
  kSuccess,
  kNoContact,            ///< not all grasping digits ever touched
  kPushedAway,           ///< the object left the fingers' reach before or during closure
  kKnockedOver,          ///< it tipped over
  kLostWhileClosing,     ///< touched, but contact was lost again before lift-off
  kSlippedInLiftOff,     ///< it did not come along
  kDroppedWhileHolding,  ///< lifted, then lost, touching the table or still slipping at the end
  kUnreachable,          ///< this grasp cannot hold this object without the palm inside it
  kNotSeen,              ///< the camera did not find the object; `reason` says why
  kArmOverloaded,        ///< object or table pushed harder on the hand than the arm can bear
  kNotPhysical,       ///< held, but in a way no real hand could: see protocols/table_lift_outcome.h
  kNumericalFailure,  ///< the simulation gave up; `reason` says why
};

/** What an outcome says about the trial. */
enum class OutcomeKind {
  kNone,
  kSuccess,
  kFailure,
  kOutOfReach,   ///< a failure that moved the object away, so that later touches tell nothing
  kMaybeInHand,  ///< a failure at whose end the object may still be in the hand
  kNumerical,    ///< tells nothing about the grasp: counts as not successful, and in no measure
};

struct OutcomeRow {
  Outcome value;
  const char* name;  ///< in files and for people
  const char* code;  ///< two letters for where there is no room
  OutcomeKind kind;
};

/** In the order in which results are shown, which is that of the enum. */
inline constexpr OutcomeRow kOutcomes[] = {
    {Outcome::kNotRun, "not run", "", OutcomeKind::kNone},
    {Outcome::kSuccess, "success", "OK", OutcomeKind::kSuccess},
    {Outcome::kNoContact, "no contact", "NC", OutcomeKind::kFailure},
    {Outcome::kPushedAway, "pushed away", "PA", OutcomeKind::kOutOfReach},
    {Outcome::kKnockedOver, "knocked over", "KO", OutcomeKind::kOutOfReach},
    {Outcome::kLostWhileClosing, "lost while closing", "LC", OutcomeKind::kFailure},
    {Outcome::kSlippedInLiftOff, "slipped in lift-off", "SL", OutcomeKind::kFailure},
    {Outcome::kDroppedWhileHolding, "dropped while holding", "DH", OutcomeKind::kMaybeInHand},
    {Outcome::kUnreachable, "unreachable", "UR", OutcomeKind::kFailure},
    {Outcome::kNotSeen, "not seen", "NS", OutcomeKind::kFailure},
    {Outcome::kArmOverloaded, "arm overloaded", "AO", OutcomeKind::kMaybeInHand},
    {Outcome::kNotPhysical, "not physical", "NP", OutcomeKind::kMaybeInHand},
    {Outcome::kNumericalFailure, "numerical failure", "NF", OutcomeKind::kNumerical},
};
/** Without kNotRun. */
inline constexpr int kNumOutcomes = static_cast<int>(std::size(kOutcomes)) - 1;

const char* NameOf(Outcome outcome);  ///< "success", "no contact", ...
const char* CodeOf(Outcome outcome);  ///< "OK", "NC", ...
bool IsSuccess(Outcome outcome);
bool IsNumericalFailure(Outcome outcome);
bool IsOutOfReach(Outcome outcome);  ///< the object was moved away
bool MayBeInHand(Outcome outcome);   ///< at the end of the hold, so that there may be a judgement

/** All outcomes but kNotRun, in the order of the table. */
const std::vector<Outcome>& ListOutcomes();
/** @throws Error(kFormat) for another name, and for that of kNotRun. */
Outcome OutcomeFromName(const std::string& name);

inline Json ToJson(Outcome outcome) { return NameOf(outcome); }
inline void ReadJson(const Json& json, Outcome& outcome) {
  outcome = OutcomeFromName(json.get<std::string>());
}

}  // namespace graspbench
