#pragma once
/** @file
What graspbench replay PACK and graspbench pipeline replay PACK do. */

#include <filesystem>

#include "core/base/error.h"

namespace CLI {
class App;
}  // namespace CLI

namespace graspbench {

struct PackReplayOptions {
  std::filesystem::path pack;
  std::filesystem::path folder;  ///< empty: nothing is kept
  int num_workers = 1;
  bool json = false;
};

/** Prints what it found. @returns kExitBadInput when a byte differs. @throws as ReplayPack. */
ExitCode ReplayPackFile(const CLI::App& program, const PackReplayOptions& options);

}  // namespace graspbench
