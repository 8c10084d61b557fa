#pragma once
/** @file
The commands that a stage of a pipeline can be, with the options that they have. */

#include <vector>

#include "datasets/pipeline/pipeline_file.h"

namespace graspbench {

class Command;

/** @param program  the command line, complete. */
std::vector<StageCommand> ListStageCommands(const Command& program);

}  // namespace graspbench
