#pragma once
/** @file What this process runs on and is; see Machine in datasets/session/worker_log.h. */

#include <string>

#include "datasets/session/worker_log.h"

namespace graspbench {

std::string FindHost();

/** Two builds of one source are the same build when their bytes are. */
const std::string& FindBuild();

Machine FindMachine();

/** At least 1. */
int CountProcessors();

}  // namespace graspbench
