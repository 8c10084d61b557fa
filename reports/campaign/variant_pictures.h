#pragma once
/** @file
The three variants of a scene's grasp side by side, closed, seen by one camera. */

#include <array>
#include <map>
#include <string>
#include <vector>

#include "datasets/analysis/campaign/campaign_summary.h"
#include "reports/scenes/cell_pictures.h"

namespace graspbench {

struct VariantPictures {
  /** By the scene's anchor; a variant without a drawable trial has an empty picture. */
  std::map<std::string, std::array<Picture, kNumVariants>> by_scene;
  std::vector<std::string> problems;  ///< why pictures are missing
};

/** Never throws for a machine that cannot draw: the reason becomes a problem. */
VariantPictures RenderVariantPictures(const Session& benchmark,
                                      const std::vector<SceneVariants>& scenes,
                                      const SessionModels& models);

}  // namespace graspbench
