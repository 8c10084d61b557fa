#pragma once
/** @file
What this process runs on and is; see Machine in datasets/shards/worker_log.h. */

#include <string>

#include "datasets/shards/worker_log.h"

namespace graspbench {

std::string FindHost();

/** Two builds of one source are the same build when their bytes are. */
const std::string& FindBuild();

Machine FindMachine();

/** At least 1. */
int CountProcessors();

}  // namespace graspbench
