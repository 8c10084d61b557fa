#include "core/base/version.h"

#include "core/base/commit.h"   // generated
#include "core/base/sources.h"  // generated

namespace graspbench {

const char* program_version() { return GRASPBENCH_VERSION; }

const char* program_commit() { return kCommit; }

const char* program_sources() { return kSources; }

}  // namespace graspbench
