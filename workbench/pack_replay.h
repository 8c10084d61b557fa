#pragma once
/** @file
What graspbench replay PACK and graspbench pipeline replay PACK do. */

#include <filesystem>

#include "core/base/error.h"

namespace graspbench {

class Command;

struct PackReplayOptions {
  std::filesystem::path pack;
  std::filesystem::path folder;  ///< empty: nothing is kept
  int num_workers = 1;
  bool json = false;
};

/** Prints what it found. @returns kExitBadInput when a byte differs. @throws as ReplayPack. */
ExitCode ReplayPackFile(const Command& program, const PackReplayOptions& options);

}  // namespace graspbench
