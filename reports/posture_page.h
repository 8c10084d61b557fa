#pragma once
/** @file
Developed postures as a page: what they look like, how far they keep the rules, what the simulation
said of them. */

#include <memory>
#include <string>
#include <vector>

#include "core/develop/develop_grasp.h"
#include "core/hand/hand.h"
#include "datasets/analysis/development_summary.h"

namespace graspbench {

struct PosturePageData {
  std::shared_ptr<const Hand> hand;
  DevelopConfig config;
  std::vector<DevelopedGrasp> developed;
  std::vector<std::vector<DevelopmentStage>> stages;  ///< by grasp, as far as known
};

/** A self-contained page like the session's report. On a machine that cannot draw it says so in the
place of pictures. @pre a grasp's digits and postures fit the hand. */
std::string MakePosturePage(const PosturePageData& data);

}  // namespace graspbench
