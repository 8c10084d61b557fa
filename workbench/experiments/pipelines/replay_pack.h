#pragma once
/** @file
A packed pipeline made again from its own inputs, and compared with what it holds, byte for byte. */

#include <atomic>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/base/text/json.h"
#include "workbench/experiments/pipelines/run_pipeline.h"

namespace graspbench {

struct PackDifference {
  std::string file;  ///< from the results: "judged/export/trials.csv"
  std::string text;  ///< how it differs, in words that follow its name
};

struct PackReplay {
  std::vector<std::string> stages;
  int num_files = 0;                    ///< that were compared
  int num_different = 0;                ///< of them
  std::optional<PackDifference> first;  ///< manifests behind everything else
  Json packed_versions, versions;       ///< program, commit, physics, judge
  bool is_same_program() const { return packed_versions == versions; }
};

/** @param results  of an earlier run; what is not stale counts.
@throws Error(kUsage) naming a stage that is stale, or when the pack exists; as FindStageStates,
GatherPack, WritePack. */
void MakePack(const Pipeline& pipeline, const std::filesystem::path& results,
              const StageFacts& program, const std::filesystem::path& pack);

struct PackReplayRequest {
  std::filesystem::path pack;
  std::filesystem::path
      folder;  ///< new: for what was packed and what is made; empty: neither stays
  std::vector<StageCommand> commands;
  int num_workers = 1;
  std::function<void(const std::string& line)> tell;
};
/** @throws as Unpack, ParsePipeline, RunPipeline. */
PackReplay ReplayPack(const PackReplayRequest& request, const std::atomic<bool>& stop);

}  // namespace graspbench
