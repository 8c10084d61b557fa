#include "core/trial/outcome.h"

#include "core/base/error.h"

namespace graspbench {

const char* NameOf(Outcome outcome) {
  switch (outcome) {
    case Outcome::kNotRun:
      return "not run";
    case Outcome::kSuccess:
      return "success";
    case Outcome::kNoContact:
      return "no contact";
    case Outcome::kPushedAway:
      return "pushed away";
    case Outcome::kKnockedOver:
      return "knocked over";
    case Outcome::kLostWhileClosing:
      return "lost while closing";
    case Outcome::kSlippedInLiftOff:
      return "slipped in lift-off";
    case Outcome::kDroppedWhileHolding:
      return "dropped while holding";
    case Outcome::kNumericalFailure:
      return "numerical failure";
  }
  return "";
}

const std::vector<Outcome>& ListOutcomes() {
  static const std::vector<Outcome> outcomes = {Outcome::kSuccess,
                                                Outcome::kNoContact,
                                                Outcome::kPushedAway,
                                                Outcome::kKnockedOver,
                                                Outcome::kLostWhileClosing,
                                                Outcome::kSlippedInLiftOff,
                                                Outcome::kDroppedWhileHolding,
                                                Outcome::kNumericalFailure};
  return outcomes;
}

Outcome OutcomeFromName(const std::string& name) {
  std::vector<std::string> known;
  for (Outcome outcome : ListOutcomes()) {
    if (name == NameOf(outcome)) return outcome;
    known.push_back(NameOf(outcome));
  }
  throw Error(ErrorKind::kFormat, "no outcome \"" + name + "\"" + SuggestNames(name, known));
}

}  // namespace graspbench
