#include "core/base/version.h"

namespace graspbench {

const char* program_version() { return GRASPBENCH_VERSION; }

}  // namespace graspbench
