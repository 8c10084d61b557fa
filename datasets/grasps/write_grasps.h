#pragma once
/** @file
Writes grasps as files of other tools. Reading them back gives bitwise equal numbers. */

#include <string>
#include <vector>

#include "datasets/grasps/grasp_files.h"

namespace graspbench {

struct WrittenGrasps {
  std::string bytes;
  std::vector<std::string> losses;  ///< what the format cannot store, one sentence each
};

/** Lists the formats that can be written: "dexgraspbench", "isaac". */
std::vector<std::string> ListWrittenFormats();

/** Writes one file with all grasps.
- dexgraspbench: .npy as from np.save, with rows of 29 numbers for one grasp and arrays (N, 29) for
  several. It has the 22 joints of its hand, poses of its root "wrist", and the stages pregrasp,
  grasp and squeeze.
- isaac: .yaml, for any hand. A grasp has one pose; a pre-grasp is a posture of the hand.
@pre at least one grasp.
@throws Error(kUsage) for an unknown format; Error(kUnsupported) for grasps of several objects or
hands, or grasps that the format cannot store. */
WrittenGrasps WriteGrasps(const std::vector<ForeignGrasp>& grasps, const std::string& format);

}  // namespace graspbench
