#pragma once
/** @file
What an optimisation decided, for the terminal. */

#include <filesystem>
#include <string>
#include <vector>

#include "core/base/text/json.h"
#include "core/optimise/grasp_optimiser.h"
#include "datasets/scene/evaluation_journal.h"
#include "datasets/scene/learning_plan.h"
#include "workbench/experiments/scene_runner.h"

namespace graspbench {

/** A line for each step, a table of the trials it was decided by, one of the opposing digit's
angles. */
std::string FormatOptimisation(const SceneInputs& inputs, const SceneConfig& config,
                               const OptimisedGrasp& result);

/** The grasps that were found and the data, a line each with a line feed. */
std::string ListSceneFiles(const std::filesystem::path& folder);

/** The same as JSON, with what result.json holds. */
Json MakeSceneJson(const std::filesystem::path& folder);

/** Which trials failed numerically, in a sentence each; endless ones are among them. Empty: none. */
std::string DescribeNumericalFailures(const std::vector<EvaluationRecord>& evaluations);

/** Whether a search's individual gave its stored numbers again, with a line feed. */
std::string FormatReplay(const ReplayedIndividual& replayed);

}  // namespace graspbench
