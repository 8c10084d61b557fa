#pragma once
/** @file
The plan of a session: one line per trial, a pure function of the configuration and of the content
of hands and objects. */

#include <string>
#include <vector>

#include "datasets/session_config.h"

namespace graspbench {

struct PlannedTrial {
  std::string id;  ///< hash of everything that matters for the result; 16 hexadecimal digits
  std::string hand;
  std::string object;
  std::string grasp;
  int trial = 0;  ///< zero-based number within the cell
};

/** Cells in the order hand, object, grasp; a hand that cannot do a grasp has no cell for it. */
std::vector<PlannedTrial> MakePlan(const SessionConfig& config);

/** The draws of a trial: object pose from (seed, object, trial) only, so that every hand and grasp
meets the same poses; joint errors from (seed, hand, object, trial). */
TrialDraw MakeTrialDraw(const SessionConfig& config, const Hand& hand, const GraspObject& object,
                        int trial);

}  // namespace graspbench
