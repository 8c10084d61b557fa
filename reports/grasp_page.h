#pragma once
/** @file
One grasp that somebody made, judged under one profile, as one page: the verdict, a moving 3-D view
of its stages and of the push or lift that decides, what was measured, the profile. */

#include <memory>
#include <string>
#include <vector>

#include "core/trial/protocols/free_space.h"

namespace graspbench {

struct GraspPageData {
  std::string name;         ///< "mug.npy, grasp 3"
  std::string object_name;  ///< as the file has it
  std::shared_ptr<const Hand> hand;
  std::shared_ptr<const GraspObject> object;
  FreeSpaceProfile profile;
  TracedFreeSpace traced;
  std::vector<std::string> assumptions;  ///< what the file does not say
  std::vector<std::string> commands;     ///< that make the page again
};

/** A self-contained page like the session's report. Without a renderer it has no pictures and says
why. */
std::string MakeGraspPage(const GraspPageData& data);

}  // namespace graspbench
