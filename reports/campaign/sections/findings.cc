#include "reports/campaign/campaign_section.h"

namespace graspbench {
namespace {

Html DrawFindings(const CampaignData& data) {
  const std::vector<std::string> findings = ListCampaignFindings(data);
  return findings.empty() ? MakeParagraph("No errors and no warnings.") : MakeList(findings);
}

}  // namespace

CampaignSection findings_campaign_section() {
  return {"findings", "Errors and warnings", DrawFindings};
}

}  // namespace graspbench
