#pragma once
/** @file
What an optimisation decided, for the terminal. */

#include <filesystem>
#include <string>
#include <vector>

#include "core/base/text/json.h"
#include "core/optimise/grasp_optimiser.h"
#include "datasets/campaign/campaign_store.h"
#include "datasets/scene/answer_journal.h"
#include "datasets/scene/scene_store.h"
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

/** A campaign's results as tables for the terminal. One row for each variant of the grasps, over
all scenes. */
std::string FormatVariantsTable(const Campaign& campaign);

/** One row for each search method; empty when none were compared. */
std::string FormatComparisonTable(const Campaign& campaign);

/** Both tables, and where the rest is. */
std::string FormatCampaign(const Campaign& campaign, const std::filesystem::path& folder,
                           const std::filesystem::path& report);
/** The same. */
Json MakeCampaignJson(const Campaign& campaign, const std::filesystem::path& folder,
                      const std::filesystem::path& report);

/** What failed numerically, by scene; empty: nothing. */
std::string DescribeNumericalFailures(const Campaign& campaign);

}  // namespace graspbench
