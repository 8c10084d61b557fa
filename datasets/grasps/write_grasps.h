#pragma once
/** @file
Grasps as files of other tools. Read again, they have the same numbers, bit by bit. */

#include <string>
#include <vector>

#include "datasets/grasps/grasp_files.h"

namespace graspbench {

struct WrittenGrasps {
  std::string bytes;
  std::vector<std::string> losses;  ///< what the format has no place for, a sentence each
};

/** The formats that can be written: "dexgraspbench", "isaac". */
std::vector<std::string> ListWrittenFormats();

/** One file of all grasps.
- dexgraspbench: .npy as np.save writes it; one grasp as rows of 29, several as arrays (N, 29). For
  the 22 joints of its hand, poses of its root "wrist", stages pregrasp, grasp, squeeze.
- isaac: .yaml; for any hand. A grasp has one pose; a pre-grasp is a posture of the hand.
@pre at least one grasp
@throws Error(kUsage) for an unknown format; Error(kUnsupported) for grasps of several objects or
hands, or that the format cannot hold. */
WrittenGrasps WriteGrasps(const std::vector<ForeignGrasp>& grasps, const std::string& format);

}  // namespace graspbench
