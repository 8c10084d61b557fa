#include "core/base/version.h"

#include "core/base/commit.h"  // generated

namespace graspbench {

const char* program_version() { return GRASPBENCH_VERSION; }

const char* program_commit() { return kCommit; }

}  // namespace graspbench
