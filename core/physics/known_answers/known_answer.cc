#include "core/physics/known_answers/known_answer.h"

#include <cmath>

namespace graspbench {

bool KnownAnswer::passes() const { return std::abs(obtained - expected) <= tolerance; }

const std::vector<KnownAnswerCheck>& ListKnownAnswerChecks() {
  static const std::vector<KnownAnswerCheck> checks = {
#define GRASPBENCH_KNOWN_ANSWER(Name, title, source) {title, source, Check##Name},
#include "core/physics/known_answers/known_answer_list.inc"
#undef GRASPBENCH_KNOWN_ANSWER
  };
  return checks;
}

}  // namespace graspbench
