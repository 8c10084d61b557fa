#pragma once
/** @file
Outcomes of a trial: one table that contains every property depending on the outcome. A new outcome
needs a value, a row, and its condition in protocols/table_lift_outcome.cc. */

#include <string>
#include <vector>

#include "core/base/enum_table.h"
#include "core/base/text/json.h"

namespace graspbench {

enum class Outcome {
  kNotRun,
  kSuccess,
  kNoContact,            ///< not all grasping digits ever touched
  kPushedAway,           ///< the object left the reach of the fingers before or during closure
  kKnockedOver,          ///< the object tipped over
  kLostWhileClosing,     ///< touched, but contact was lost again before lift-off
  kSlippedInLiftOff,     ///< the object was not lifted with the hand
  kDroppedWhileHolding,  ///< lifted, then lost, touching the table or still slipping at the end
  kUnreachable,          ///< this grasp cannot hold this object without the palm inside it
  kArmOutOfReach,        ///< the arm has no posture for the grasp (core/arm/arm_course.h)
  kNoStraightPath,       ///< the arm has one, but cannot approach or lift in a straight line
  kNearSingularity,      ///< a joint of the arm would be too fast near a singular posture
  kNotSeen,              ///< the camera did not find the object; `reason` says why
  kArmOverloaded,        ///< object or table pushed harder on the hand than the arm can bear
  kNotPhysical,       ///< held, but in a way no real hand could: see protocols/table_lift_outcome.h
  kWrongAnswer,       ///< the controller gave an invalid answer; `reason` says how
  kNumericalFailure,  ///< the simulation failed; `reason` says why
};

/** Category of an outcome. */
enum class OutcomeKind {
  kNone,
  kSuccess,
  kFailure,
  kOutOfReach,   ///< a failure that moved the object away, so that later touches are meaningless
  kMaybeInHand,  ///< a failure after which the object may still be in the hand
  kNumerical,    ///< no result about the grasp: not a success, and excluded from all measures
};

struct OutcomeRow {
  Outcome value;
  const char* name;  ///< in files and reports
  const char* code;  ///< two-letter abbreviation
  OutcomeKind kind;
};

/** In display order, which is that of the enum. */
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
    {Outcome::kArmOutOfReach, "arm cannot reach", "AR", OutcomeKind::kFailure},
    {Outcome::kNoStraightPath, "no straight path", "SP", OutcomeKind::kFailure},
    {Outcome::kNearSingularity, "near a singularity", "SG", OutcomeKind::kFailure},
    {Outcome::kNotSeen, "not seen", "NS", OutcomeKind::kFailure},
    {Outcome::kArmOverloaded, "arm overloaded", "AO", OutcomeKind::kMaybeInHand},
    {Outcome::kNotPhysical, "not physical", "NP", OutcomeKind::kMaybeInHand},
    {Outcome::kWrongAnswer, "wrong answer", "WA", OutcomeKind::kFailure},
    {Outcome::kNumericalFailure, "numerical failure", "NF", OutcomeKind::kNumerical},
};
/** Number of outcomes without kNotRun. */
inline constexpr int kNumOutcomes = static_cast<int>(std::size(kOutcomes)) - 1;

/** "success", "no contact", ... */
inline const char* NameOf(Outcome outcome) { return RowOf(kOutcomes, outcome).name; }
/** "OK", "NC", ... */
inline const char* CodeOf(Outcome outcome) { return RowOf(kOutcomes, outcome).code; }
inline OutcomeKind KindOf(Outcome outcome) { return RowOf(kOutcomes, outcome).kind; }
inline bool IsSuccess(Outcome outcome) { return KindOf(outcome) == OutcomeKind::kSuccess; }
inline bool IsNumericalFailure(Outcome outcome) {
  return KindOf(outcome) == OutcomeKind::kNumerical;
}
/** Whether the object was moved away. */
inline bool IsOutOfReach(Outcome outcome) { return KindOf(outcome) == OutcomeKind::kOutOfReach; }
/** Whether the object may be in the hand at the end of the hold, so that it can be judged. */
inline bool MayBeInHand(Outcome outcome) {
  return IsSuccess(outcome) || KindOf(outcome) == OutcomeKind::kMaybeInHand;
}

/** All outcomes except kNotRun, in the order of the table. */
inline const std::vector<Outcome>& ListOutcomes() {
  static const std::vector<Outcome> outcomes = [] {
    std::vector<Outcome> all;
    for (const OutcomeRow& row : kOutcomes) {
      if (row.kind != OutcomeKind::kNone) all.push_back(row.value);
    }
    return all;
  }();
  return outcomes;
}
/** @throws Error(kFormat) for an unknown name, and for that of kNotRun. */
inline Outcome OutcomeFromName(const std::string& name) {
  const OutcomeRow* row = FindRow(kOutcomes, name);
  if (row && row->kind != OutcomeKind::kNone) return row->value;
  std::vector<std::string> known;
  for (const Outcome outcome : ListOutcomes()) known.push_back(NameOf(outcome));
  throw Error(ErrorKind::kFormat, "no outcome \"" + name + "\"" + SuggestNames(name, known));
}

inline Json ToJson(Outcome outcome) { return NameOf(outcome); }
inline void ReadJson(const Json& json, Outcome& outcome) {
  outcome = OutcomeFromName(json.get<std::string>());
}

}  // namespace graspbench
