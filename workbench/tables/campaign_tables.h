#pragma once
/** @file
A campaign's results as tables for the terminal. */

#include <filesystem>
#include <string>

#include "core/base/text/json.h"
#include "datasets/campaign/campaign_store.h"

namespace graspbench {

/** One row for each variant of the grasps, over all scenes. */
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
