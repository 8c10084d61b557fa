#pragma once
/** @file
Results of an optimisation, as text for the terminal. */

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

/** A line for each step, a table of the deciding trials, and one of the opposing digit's angles. */
std::string FormatOptimisation(const SceneInputs& inputs, const SceneConfig& config,
                               const OptimisedGrasp& result);

/** Paths of the resulting grasps and data, one per line. */
std::string ListSceneFiles(const std::filesystem::path& folder);

/** As ListSceneFiles, as JSON with the content of result.json. */
Json MakeSceneJson(const std::filesystem::path& folder);

/** One sentence per trial that failed numerically or timed out; empty: none. */
std::string DescribeNumericalFailures(const std::vector<EvaluationRecord>& evaluations);

/** One line: whether the re-simulated individual matches its stored results. */
std::string FormatReplay(const ReplayedIndividual& replayed);

/** A campaign's results for the terminal: one row for each variant of the grasps, over all
scenes. */
std::string FormatVariantsTable(const Campaign& campaign);

/** One row for each search method; empty when none were compared. */
std::string FormatComparisonTable(const Campaign& campaign);

/** Both tables, and the paths of further results. */
std::string FormatCampaign(const Campaign& campaign, const std::filesystem::path& folder,
                           const std::filesystem::path& report);
/** As FormatCampaign, as JSON. */
Json MakeCampaignJson(const Campaign& campaign, const std::filesystem::path& folder,
                      const std::filesystem::path& report);

/** Numerical failures by scene; empty: none. */
std::string DescribeNumericalFailures(const Campaign& campaign);

}  // namespace graspbench
