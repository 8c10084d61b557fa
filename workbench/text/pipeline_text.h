#pragma once
/** @file
Pipelines and what they found, for people and for other programs. */

#include <string>
#include <vector>

#include "core/base/text/json.h"
#include "datasets/pipeline/pipeline_state.h"
#include "workbench/experiments/pipelines/replay_pack.h"

namespace graspbench {

/** A line a stage: fresh or stale, and below it because of what. */
std::string FormatStageStates(const std::vector<StageState>& states);
Json MakeStatesJson(const std::vector<StageState>& states);

/** A line a stage: its command line and what it waits for. */
std::string FormatGraph(const Pipeline& pipeline);
/** For Graphviz. */
std::string FormatDot(const Pipeline& pipeline);

/** dvc.yaml of DVC 3, and a Snakefile of Snakemake 7: the same commands, to be run in the
pipeline's own folder, where they make a folder a stage. @throws Error(kUnsupported) for a name that
Snakemake cannot have. */
///@{
std::string FormatDvc(const Pipeline& pipeline);
std::string FormatSnakefile(const Pipeline& pipeline);
///@}

std::string FormatPackReplay(const PackReplay& replay);
Json MakePackReplayJson(const PackReplay& replay);

}  // namespace graspbench
