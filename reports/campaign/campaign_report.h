#pragma once
/** @file
The evaluation of the optimisation, from a campaign's stored results alone. */

#include <filesystem>
#include <string>

#include "reports/campaign/campaign_section.h"

namespace graspbench {

/** The whole page. */
std::string MakeCampaignReport(const CampaignData& data);

/** Writes report/index.html into the campaign's folder and returns its path. What is not finished
is left out and said. @throws Error(kIo). */
std::filesystem::path WriteCampaignReport(const std::filesystem::path& folder,
                                          const Campaign& campaign);

}  // namespace graspbench
