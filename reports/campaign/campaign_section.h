#pragma once
/** @file
A section of a campaign's report. A new one is one file in sections/ that defines
`CampaignSection <name>_campaign_section()` and one line in section_list.inc, which fixes the order
of the page. */

#include <vector>

#include "datasets/analysis/campaign/campaign_summary.h"
#include "reports/campaign/variant_pictures.h"
#include "reports/page/models.h"
#include "reports/page/sectioned_page.h"

namespace graspbench {

struct CampaignData {
  const Campaign& campaign;
  const SessionSummary& benchmark;
  const std::vector<SceneVariants>& scenes;
  const SessionModels& models;
  const VariantPictures& pictures;

  /** "TUM Hand, can". */
  std::string NameOfScene(const SceneVariants& scene) const {
    return models.NameOfHand(scene.hand) + ", " + models.NameOfObject(scene.object);
  }
};

/** Must bear a campaign of which nothing is finished. */
using CampaignSection = PageSection<CampaignData>;

std::vector<CampaignSection> ListCampaignSections();

#define GRASPBENCH_CAMPAIGN_SECTION(name) CampaignSection name##_campaign_section();
#include "reports/campaign/sections/section_list.inc"
#undef GRASPBENCH_CAMPAIGN_SECTION

}  // namespace graspbench
