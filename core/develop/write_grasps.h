#pragma once
/** @file
Writes developed grasps as the section `grasps` of hand.yaml, each with a sentence on its origin. */

#include <string>
#include <vector>

#include "core/develop/develop_grasp.h"

namespace graspbench {

/** Describes how a grasp was developed. */
std::string DescribeDevelopment(const Hand& hand, const DevelopedGrasp& developed);

/** Formats the section, with a comment above it. */
std::string FormatGrasps(const Hand& hand, const DevelopConfig& config,
                         const std::vector<DevelopedGrasp>& developed);

/** Returns hand.yaml with its section replaced by `section`, or with `section` at its end. A
comment that there are no grasps is removed. All else is unchanged. */
std::string ReplaceGrasps(const std::string& hand_yaml, const std::string& section);

}  // namespace graspbench
