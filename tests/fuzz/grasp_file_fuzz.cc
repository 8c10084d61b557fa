// Any bytes as a grasp file of the TUM Hand: refused with an Error, or a grasp that the hand can
// take and that is read again from what is written of it.
#include <string>

#include "core/grasp/grasp_file.h"
#include "core/grasp/placement.h"
#include "core/hand/load_hand.h"
#include "tests/fuzz/fuzz_target.h"

namespace graspbench {

void FuzzInput(const std::string& bytes) {
  static const Hand hand = LoadHand("tum");
  try {
    const Grasp grasp = ParseGraspFile(bytes, "fuzz", {&hand}).grasp;
    for (const double s : {0.0, 0.5, 1.0}) {
      const Eigen::VectorXd q = CalcClosingPosture(hand, grasp, s);
      for (int j = 0; j < hand.num_joints(); ++j) {
        const HandJoint& joint = hand.joints[static_cast<size_t>(j)];
        GRASPBENCH_DEMAND(q[j] >= joint.lower - 1e-9 && q[j] <= joint.upper + 1e-9, joint.name);
      }
    }
    const Placement placement =
        CalcPlacement(hand, grasp, {0.05, 0.04, 0.03}, Eigen::Vector3d::Zero());
    GRASPBENCH_DEMAND(placement.X_WH.matrix().allFinite(), "the hand's place is not finite");
  } catch (const Error&) {
  }
}

}  // namespace graspbench
