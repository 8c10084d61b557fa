#pragma once
/** @file
What an optimisation decided, for the terminal. */

#include <string>

#include "core/optimise/grasp_optimiser.h"
#include "datasets/scene/learning_plan.h"

namespace graspbench {

/** A line for each step, a table of the trials it was decided by, one of the opposing digit's
angles. */
std::string FormatOptimisation(const SceneInputs& inputs, const SceneConfig& config,
                               const OptimisedGrasp& result);

}  // namespace graspbench
