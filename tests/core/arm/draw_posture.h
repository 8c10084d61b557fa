#pragma once

#include "core/arm/arm.h"
#include "core/base/random.h"

namespace graspbench {

/** Uniform within the limits. */
inline Eigen::VectorXd DrawPosture(const Arm& arm, RandomStream& random) {
  Eigen::VectorXd q(arm.num_joints());
  for (int i = 0; i < arm.num_joints(); ++i) {
    const ArmJoint& joint = arm.joints[static_cast<size_t>(i)];
    q[i] = random.NextUniform(joint.lower, joint.upper);
  }
  return q;
}

}  // namespace graspbench
