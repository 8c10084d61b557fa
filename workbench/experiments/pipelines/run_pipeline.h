#pragma once
/** @file
Runs the stages of a pipeline that are stale, each as a process of this program, those that do not
need each other at the same time. A stage counts when its line is in the lock file
(datasets/pipeline/pipeline_state.h): after a crash those that do are not run again, and a run,
campaign or optimisation that had begun goes on where it was.

What somebody has changed in a result is never removed: its folder is renamed to `<stage>.set-aside`
before the stage runs again. */

#include <atomic>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "datasets/pipeline/pipeline_state.h"

namespace graspbench {

/** The program's bytes, and the hands and objects that it brings. */
StageFacts FindProgramFacts();

struct PipelineRequest {
  std::filesystem::path results;  ///< new, empty or of an earlier run
  StageFacts program;
  int num_workers = 1;  ///< processors for all stages together
  std::function<void(const std::string& line)> tell = [](const std::string&) {};
};

/** @returns the stages that ran, as they ended. None is stale any more.
@throws Error(kUsage) when the folder holds something else or belongs to an input; kIo, also when
another run is at work there; kInterrupted when `stop` was set; what a stage that failed implies. */
std::vector<std::string> RunPipeline(const Pipeline& pipeline, const PipelineRequest& request,
                                     const std::atomic<bool>& stop);

}  // namespace graspbench
