#pragma once
/** @file
Where the digits' last links are for given joint angles. */

#include <string>
#include <vector>

namespace graspbench {

/** Prints the pose of each digit's last link in the palm's frame. @param joints  "FFJ3=30": angles
in degrees; others are zero, coupled ones follow unless they are named. @param link  or another
frame of the description, instead of those; empty: none.
@throws Error(kUsage) for an unknown joint or link, or no number. */
void PrintForwardKinematics(const std::string& hand, const std::vector<std::string>& joints,
                            const std::string& link, bool json);

}  // namespace graspbench
