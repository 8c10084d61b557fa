/** @file
Target: session.yaml, and the text behind --set. */

#include "tests/fuzz/fuzz_session.h"

namespace graspbench {

void FuzzInput(const std::string& bytes) { FuzzSessionYaml(bytes); }

}  // namespace graspbench
