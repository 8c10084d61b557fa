/** @file
Target: a line of a journal: of trials, judgements, evaluations, developments, workers. */

#include "tests/fuzz/fuzz_session.h"

namespace graspbench {

void FuzzInput(const std::string& bytes) { FuzzJournalLine(bytes); }

}  // namespace graspbench
