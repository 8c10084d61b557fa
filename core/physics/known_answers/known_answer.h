#pragma once
/** @file
What the engine must get right, with the answer known beforehand from a closed form, a conservation
law or Simbody: the sheet that `graspbench selftest` prints and that the tests hold.

Every check runs the engine of the trials itself (World), on bodies and small hands
whose answer can be worked out, and on the real hands. One more check: a function
`std::vector<KnownAnswer> Check<Name>()` in the file of its subject, and a line in
known_answer_list.inc. */

#include <string>
#include <vector>

namespace graspbench {

struct KnownAnswer {
  std::string what;  ///< "mu 0.3, step 2 ms"
  std::string unit;  ///< of the three numbers; "" for a ratio
  double expected = 0.0;
  double obtained = 0.0;
  double tolerance = 0.0;

  /** |obtained - expected| <= tolerance; false when something is not a number. */
  bool passes() const;
};

struct KnownAnswerCheck {
  std::string name;    ///< "free fall"
  std::string source;  ///< where the expected values come from
  std::vector<KnownAnswer> (*run)();
};

/** All checks, in the order of the sheet. */
const std::vector<KnownAnswerCheck>& ListKnownAnswerChecks();

#define GRASPBENCH_KNOWN_ANSWER(Name, title, source) std::vector<KnownAnswer> Check##Name();
#include "core/physics/known_answers/known_answer_list.inc"
#undef GRASPBENCH_KNOWN_ANSWER

}  // namespace graspbench
