#pragma once
/** @file
A foreign grasp as a hand of graspbench has it: poses of its frame H in the object and a position for
each of its joints, by names. */

#include <Eigen/Core>
#include <string>
#include <vector>

#include "core/base/pose.h"
#include "core/hand/hand.h"
#include "datasets/grasps/foreign_grasp.h"

namespace graspbench {

struct HandStage {
  std::string name;
  Pose X_OH;          ///< O: the object as its scaled mesh is drawn [m]
  Eigen::VectorXd q;  ///< of all joints [rad], [m]; may lie outside the joints' limits
};

struct HandGrasp {
  std::vector<HandStage> stages;
  std::vector<std::string> assumptions;  ///< those of the file, then those of the mapping
};

/** Joints are found by their names; a hand may put a prefix before them: "rh_FFJ4" is "FFJ4". What
DexGraspNet calls robot0:FFJ3 is FFJ4 of a hand with the maker's names (shadow_layout.h).

Joints that the file does not state: coupled ones follow their coupling, those of the wrist are at
0; both are noted. Others are an error. Coupled joints that the file states are taken as stated: q
need not obey the hand's coupling.

@throws Error(kFormat) naming joints or links that the hand or the file does not have, and, for
DexGraspBench, a hand whose joints lie more than 1 mm from those of the hand that the format means.
*/
HandGrasp MapToHand(const ForeignGrasp& grasp, const Hand& hand);

}  // namespace graspbench
