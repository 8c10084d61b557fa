#pragma once
/** @file
Angles of a rotation as URDF has them. */

#include <Eigen/Geometry>
#include <cmath>

namespace graspbench {

/** R = Rot(z, yaw) Rot(y, pitch) Rot(x, roll): roll, pitch, yaw [rad]. One angle after the other is
taken out, so that they stay exact where the pitch is 90 degrees. */
inline Eigen::Vector3d CalcRollPitchYaw(const Eigen::Matrix3d& R) {
  const double yaw = std::atan2(R(1, 0), R(0, 0));
  const Eigen::Matrix3d tilted = Eigen::AngleAxisd(-yaw, Eigen::Vector3d::UnitZ()) * R;
  return {std::atan2(-tilted(1, 2), tilted(1, 1)), std::atan2(-tilted(2, 0), tilted(0, 0)), yaw};
}

}  // namespace graspbench
