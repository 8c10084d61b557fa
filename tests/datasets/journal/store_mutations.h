#pragma once
/** @file
Stores of every kind, small and made up, and random damage to them. */

#include <filesystem>
#include <string>
#include <vector>

namespace graspbench {

/** A session that is judged, another one, a scene, a campaign with two scenes, a benchmark and a
comparison, and a study; all sealed. @returns the folders. */
std::vector<std::filesystem::path> MakeStores(const std::filesystem::path& folder);

struct MutationCount {
  int mutations = 0;
  int undetected = 0;
  int records_lost = 0;  ///< whole lines that were still there and that repairing threw away
  std::string examples;  ///< of what went wrong, one line each
};
/** Makes `count` changes, one at a time, in stores made in `folder`: flips bits, cuts, deletes and
swaps files and lines. Each must be found by CheckStore, and repairing must keep every whole
line. */
MutationCount MutateStores(const std::filesystem::path& folder, const std::string& seed, int count);

}  // namespace graspbench
