#include "core/trial/outcome.h"

namespace graspbench {

const char* NameOf(Outcome outcome) { return RowOf(kOutcomes, outcome).name; }
const char* CodeOf(Outcome outcome) { return RowOf(kOutcomes, outcome).code; }

bool IsSuccess(Outcome outcome) { return RowOf(kOutcomes, outcome).kind == OutcomeKind::kSuccess; }

bool IsNumericalFailure(Outcome outcome) {
  return RowOf(kOutcomes, outcome).kind == OutcomeKind::kNumerical;
}

bool IsOutOfReach(Outcome outcome) {
  return RowOf(kOutcomes, outcome).kind == OutcomeKind::kOutOfReach;
}

bool MayBeInHand(Outcome outcome) {
  return IsSuccess(outcome) || RowOf(kOutcomes, outcome).kind == OutcomeKind::kMaybeInHand;
}

const std::vector<Outcome>& ListOutcomes() {
  static const std::vector<Outcome> outcomes = [] {
    std::vector<Outcome> all;
    for (const OutcomeRow& row : kOutcomes) {
      if (row.kind != OutcomeKind::kNone) all.push_back(row.value);
    }
    return all;
  }();
  return outcomes;
}

Outcome OutcomeFromName(const std::string& name) {
  const OutcomeRow* row = FindRow(kOutcomes, name);
  if (row && row->kind != OutcomeKind::kNone) return row->value;
  std::vector<std::string> known;
  for (const Outcome outcome : ListOutcomes()) known.push_back(NameOf(outcome));
  throw Error(ErrorKind::kFormat, "no outcome \"" + name + "\"" + SuggestNames(name, known));
}

}  // namespace graspbench
