#pragma once
/** @file
The report of a campaign, made from its stored results alone. */

#include <filesystem>
#include <string>

#include "reports/campaign/campaign_section.h"

namespace graspbench {

/** Makes the whole page. */
std::string MakeCampaignReport(const CampaignData& data);

/** Writes report/index.html into the campaign's folder and returns its path. Unfinished parts are
left out and named. @throws Error(kIo). */
std::filesystem::path WriteCampaignReport(const std::filesystem::path& folder,
                                          const Campaign& campaign);

}  // namespace graspbench
