#pragma once
/** @file
The robustness basin of one grasp as a page: a map of offsets in slices of yaw, and its radius. */

#include <string>
#include <vector>

#include "core/trial/basin.h"

namespace graspbench {

struct BasinPageData {
  std::string title;    ///< names hand, object and grasp
  std::string command;  ///< that gives the same samples
  std::vector<BasinSample> samples;
  /** Grip thresholds as margins, one a sample, infinite: no grip held; empty: not looked for. */
  std::vector<double> thresholds = {};
};

/** A self-contained page like the session's report. */
std::string MakeBasinPage(const BasinPageData& data);

}  // namespace graspbench
