#pragma once
/** @file
Files that a stage would read though its pipeline does not name them: an object's folder given by a
session file, recordings of a study. Nobody would see them change, and no pack would hold them. */

#include "datasets/pipeline/pipeline_file.h"

namespace graspbench {

/** A fault for each value in a YAML file among the stage's inputs that is a path outside of them, by
its root or by "..", and leads to something. */
void CheckHiddenInputs(const Pipeline& pipeline, const PipelineStage& stage, Diagnostics& problems);

}  // namespace graspbench
