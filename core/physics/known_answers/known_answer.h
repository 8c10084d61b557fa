#pragma once
/** @file
Physics verification: results with a known answer from a closed form, a conservation law or Simbody.
`graspbench selftest` prints the table, and the tests check it.

Every check runs the engine of the trials itself (World), on bodies and small hands with a
computable answer and on the real hands. To add a check, write a function `std::vector<KnownAnswer>
Check<Name>()` in the file of its subject and a line in known_answer_list.inc. */

#include <string>
#include <vector>

namespace graspbench {

struct KnownAnswer {
  std::string what;  ///< "mu 0.3, step 2 ms"
  std::string unit;  ///< of the three numbers; "": a ratio
  double expected = 0.0;
  double obtained = 0.0;
  double tolerance = 0.0;

  /** Returns whether |obtained - expected| <= tolerance; false if a number is NaN. */
  bool passes() const;
};

struct KnownAnswerCheck {
  std::string name;    ///< "free fall"
  std::string source;  ///< source of the expected values
  std::vector<KnownAnswer> (*run)();
};

/** Returns all checks, in the order of the table. */
const std::vector<KnownAnswerCheck>& ListKnownAnswerChecks();

#define GRASPBENCH_KNOWN_ANSWER(Name, title, source) std::vector<KnownAnswer> Check##Name();
#include "core/physics/known_answers/known_answer_list.inc"
#undef GRASPBENCH_KNOWN_ANSWER

}  // namespace graspbench
