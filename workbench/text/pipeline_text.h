#pragma once
/** @file
Pipelines and their results, as text and for other programs. */

#include <string>
#include <vector>

#include "core/base/text/json.h"
#include "datasets/pipeline/pipeline_state.h"
#include "workbench/experiments/pipelines/replay_pack.h"

namespace graspbench {

/** One line per stage, fresh or stale, followed by the reasons. */
std::string FormatStageStates(const std::vector<StageState>& states);
Json MakeStatesJson(const std::vector<StageState>& states);

/** One line per stage: its command line and the stages it depends on. */
std::string FormatGraph(const Pipeline& pipeline);
/** The graph in the DOT language of Graphviz. */
std::string FormatDot(const Pipeline& pipeline);

/** Format the stages as dvc.yaml (DVC 3) and as a Snakefile (Snakemake 7). The commands are to be
run in the pipeline's folder and create one folder per stage there. @throws Error(kUnsupported) for
a name that Snakemake does not allow. */
///@{
std::string FormatDvc(const Pipeline& pipeline);
std::string FormatSnakefile(const Pipeline& pipeline);
///@}

std::string FormatPackReplay(const PackReplay& replay);
Json MakePackReplayJson(const PackReplay& replay);

}  // namespace graspbench
