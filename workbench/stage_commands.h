#pragma once
/** @file
The commands that a pipeline stage can run, with their options; and replays of pipeline packs. */

#include <filesystem>
#include <vector>

#include "core/base/error.h"
#include "datasets/pipeline/pipeline_file.h"

namespace graspbench {

class Command;

/** Lists the commands that a stage can run. @param program  the complete command line. */
std::vector<StageCommand> ListStageCommands(const Command& program);

struct PackReplayOptions {
  std::filesystem::path pack;
  std::filesystem::path folder;  ///< for the results; empty: none are kept
  int num_workers = 1;
  bool json = false;
};

/** Implements graspbench replay PACK and graspbench pipeline replay PACK: reruns the pack and
prints the comparison. @returns kExitBadInput when a byte differs. @throws as ReplayPack. */
ExitCode ReplayPackFile(const Command& program, const PackReplayOptions& options);

}  // namespace graspbench
