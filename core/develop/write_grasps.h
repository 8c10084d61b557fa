#pragma once
/** @file
Developed grasps as the section `grasps` of hand.yaml, each with a sentence on where it is
from. */

#include <string>
#include <vector>

#include "core/develop/develop_grasp.h"

namespace graspbench {

/** How a developed grasp came to be, in words. */
std::string DescribeDevelopment(const Hand& hand, const DevelopedGrasp& developed);

/** The section, with a comment above it. */
std::string FormatGrasps(const Hand& hand, const DevelopConfig& config,
                         const std::vector<DevelopedGrasp>& developed);

/** hand.yaml with `section` in the place of its own, or at its end; a comment that says that there
are none goes. What else stands there stays as it is. */
std::string ReplaceGrasps(const std::string& hand_yaml, const std::string& section);

}  // namespace graspbench
