#pragma once
/** @file
The commands that a stage of a pipeline can be, with the options that they have; and packs of
pipelines, made again. */

#include <filesystem>
#include <vector>

#include "core/base/error.h"
#include "datasets/pipeline/pipeline_file.h"

namespace graspbench {

class Command;

/** @param program  the command line, complete. */
std::vector<StageCommand> ListStageCommands(const Command& program);

struct PackReplayOptions {
  std::filesystem::path pack;
  std::filesystem::path folder;  ///< empty: nothing is kept
  int num_workers = 1;
  bool json = false;
};

/** What graspbench replay PACK and graspbench pipeline replay PACK do: makes the pack again and
prints what it found. @returns kExitBadInput when a byte differs. @throws as ReplayPack. */
ExitCode ReplayPackFile(const Command& program, const PackReplayOptions& options);

}  // namespace graspbench
