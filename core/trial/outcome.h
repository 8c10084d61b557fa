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
  kArmOutOfReach,        ///< the arm has no posture for the grasp (core/arm/arm_course.h)
  kNoStraightPath,       ///< it has, but cannot approach or lift in a straight line
  kNearSingularity,      ///< it can, but a joint would be too fast near a singular posture
  kNotSeen,              ///< the camera did not find the object; `reason` says why
  kArmOverloaded,        ///< object or table pushed harder on the hand than the arm can bear
  kNotPhysical,       ///< held, but in a way no real hand could: see protocols/table_lift_outcome.h
  kWrongAnswer,       ///< its controller answered what it must not; `reason` says what
  kNumericalFailure,  ///< the simulation failed; `reason` says why
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
    {Outcome::kArmOutOfReach, "arm cannot reach", "AR", OutcomeKind::kFailure},
    {Outcome::kNoStraightPath, "no straight path", "SP", OutcomeKind::kFailure},
    {Outcome::kNearSingularity, "near a singularity", "SG", OutcomeKind::kFailure},
    {Outcome::kNotSeen, "not seen", "NS", OutcomeKind::kFailure},
    {Outcome::kArmOverloaded, "arm overloaded", "AO", OutcomeKind::kMaybeInHand},
    {Outcome::kNotPhysical, "not physical", "NP", OutcomeKind::kMaybeInHand},
    {Outcome::kWrongAnswer, "wrong answer", "WA", OutcomeKind::kFailure},
    {Outcome::kNumericalFailure, "numerical failure", "NF", OutcomeKind::kNumerical},
};
/** Without kNotRun. */
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
/** The object was moved away. */
inline bool IsOutOfReach(Outcome outcome) { return KindOf(outcome) == OutcomeKind::kOutOfReach; }
/** At the end of the hold, so that there may be a judgement. */
inline bool MayBeInHand(Outcome outcome) {
  return IsSuccess(outcome) || KindOf(outcome) == OutcomeKind::kMaybeInHand;
}

/** All outcomes but kNotRun, in the order of the table. */
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
/** @throws Error(kFormat) for another name, and for that of kNotRun. */
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
