#pragma once
/** @file
Reruns a packed pipeline from its own inputs and compares the results with the packed ones, byte for
byte. */

#include <atomic>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/base/text/json.h"
#include "workbench/experiments/pipelines/run_pipeline.h"

namespace graspbench {

struct PackDifference {
  std::string file;  ///< relative to the results: "judged/export/trials.csv"
  std::string text;  ///< how it differs; a phrase to follow the file name
};

struct PackReplay {
  std::vector<std::string> stages;
  int num_files = 0;                    ///< files compared
  int num_different = 0;                ///< files that differ
  std::optional<PackDifference> first;  ///< manifests come last
  Json packed_versions, versions;       ///< program, commit, physics, judge
  bool is_same_program() const { return packed_versions == versions; }
};

/** Packs a pipeline with its results. @param results  folder of an earlier run, without stale
stages.
@throws Error(kUsage) naming a stage that is stale, or when the pack exists; as FindStageStates,
GatherPack, WritePack. */
void MakePack(const Pipeline& pipeline, const std::filesystem::path& results,
              const StageFacts& program, const std::filesystem::path& pack);

struct PackReplayRequest {
  std::filesystem::path pack;
  std::filesystem::path
      folder;  ///< new; receives the packed and the new results; empty: neither is kept
  std::vector<StageCommand> commands;
  int num_workers = 1;
  std::function<void(const std::string& line)> tell;
};
/** Reruns a pack and compares the results. @throws as Unpack, ParsePipeline, RunPipeline. */
PackReplay ReplayPack(const PackReplayRequest& request, const std::atomic<bool>& stop);

}  // namespace graspbench
