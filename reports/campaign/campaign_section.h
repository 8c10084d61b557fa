#pragma once
/** @file
A section of a campaign's report. A new one is one file in sections/ that defines
`CampaignSection <name>_campaign_section()` and one line in section_list.inc, which fixes the order
of the page. */

#include <array>
#include <map>
#include <string>
#include <vector>

#include "datasets/analysis/campaign/campaign_summary.h"
#include "reports/page/layout.h"
#include "reports/page/models.h"
#include "reports/scenes/cell_pictures.h"

namespace graspbench {

/** Pictures of the three variants of a scene's grasp, closed, from one camera. */
struct VariantPictures {
  /** By scene anchor; a variant without a drawable trial has an empty picture. */
  std::map<std::string, std::array<Picture, kNumVariants>> by_scene;
  std::vector<std::string> problems;  ///< why pictures are missing
};

/** Renders the pictures. If the machine cannot draw, the reason becomes a problem; nothing is
thrown. */
VariantPictures RenderVariantPictures(const Session& benchmark,
                                      const std::vector<SceneVariants>& scenes,
                                      const SessionModels& models);

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

/** A section must accept a campaign without finished parts. */
using CampaignSection = PageSection<CampaignData>;

std::vector<CampaignSection> ListCampaignSections();

#define GRASPBENCH_CAMPAIGN_SECTION(name) CampaignSection name##_campaign_section();
#include "reports/campaign/sections/section_list.inc"
#undef GRASPBENCH_CAMPAIGN_SECTION

/** Lists, as sentences, all limitations of a campaign's results: unfinished scenes, damage, missing
models and pictures, numerical failures, unjudged grasps. Empty for a flawless campaign. */
std::vector<std::string> ListCampaignFindings(const CampaignData& data);

}  // namespace graspbench
