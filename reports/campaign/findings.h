#pragma once
/** @file
Everything a reader of a campaign must know before trusting the numbers, as sentences. */

#include <string>
#include <vector>

#include "reports/campaign/campaign_section.h"

namespace graspbench {

/** Scenes that are not finished, damage, models and pictures that are missing, trials that failed
numerically, grasps that are not judged. Empty for a flawless campaign. */
std::vector<std::string> ListCampaignFindings(const CampaignData& data);

}  // namespace graspbench
