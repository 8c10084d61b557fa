#include "core/hand/import/fix_joint.h"

#include <Eigen/Geometry>

namespace graspbench {

void FixJoint(ForeignHand& hand, int index, double q) {
  ForeignJoint& joint = hand.joints[static_cast<size_t>(index)];
  if (joint.kind == ForeignJoint::Kind::kPrismatic) joint.X_PJ.translate(q * joint.axis);
  if (joint.kind == ForeignJoint::Kind::kRevolute) {
    joint.X_PJ.rotate(Eigen::AngleAxisd(q, joint.axis));
  }
  joint.kind = ForeignJoint::Kind::kFixed;
  joint.mimic.reset();
  for (size_t j = 0; j < hand.joints.size(); ++j) {
    const auto mimic = hand.joints[j].mimic;
    if (mimic && mimic->joint == index) {
      FixJoint(hand, static_cast<int>(j), mimic->offset + mimic->ratio * q);
    }
  }
}

}  // namespace graspbench
