/** @file
Target for one importer, named by GRASPBENCH_FUZZ_IMPORTER at compile time. */

#include "tests/fuzz/fuzz_import.h"
#include "tests/fuzz/fuzz_target.h"

namespace graspbench {

void FuzzInput(const std::string& bytes) { FuzzImport(GRASPBENCH_FUZZ_IMPORTER, bytes); }

}  // namespace graspbench
