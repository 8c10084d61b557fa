#pragma once
/** @file
Runs the stale stages of a pipeline, each as a process of this program; independent stages run in
parallel. A stage is complete when its line is in the lock file
(datasets/pipeline/pipeline_state.h). After a crash, complete stages are not run again, and an
interrupted run, campaign or optimisation is continued.

A result that was edited is never removed: its folder is renamed to `<stage>.set-aside` before the
stage runs again. */

#include <atomic>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "datasets/pipeline/pipeline_state.h"

namespace graspbench {

/** Hashes of the program's bytes and of the hands and objects that come with it. */
StageFacts FindProgramFacts();

struct PipelineRequest {
  std::filesystem::path results;  ///< folder: new, empty or of an earlier run
  StageFacts program;
  int num_workers = 1;  ///< processors for all stages together
  std::function<void(const std::string& line)> tell = [](const std::string&) {};
};

/** Runs all stale stages. @returns the stages that ran, in the order in which they ended.
@throws Error(kUsage) when the folder holds something else or belongs to an input; kIo, also when
another run is working there; kInterrupted when `stop` was set; the error that a failed stage
implies. */
std::vector<std::string> RunPipeline(const Pipeline& pipeline, const PipelineRequest& request,
                                     const std::atomic<bool>& stop);

}  // namespace graspbench
