#pragma once
/** @file
Frames and poses.

Frames (right-handed), by letter:

    W   world: z up, origin on the table's top      H   hand base: fixed to the link the arm
                                                        carries, = the palm's frame at rest
    L   a link of the hand                          F   a finger's last link (F1 thumb .. F5)
    O   object: centre of the bounding box as it rests; x along its length, y its width, z up
    Ocm the object's frame moved to its centre of mass
    C   a contact                                   K   camera: x right, y down, z forward

Monogram notation: `X_WO` is the pose of O in W, `p_WC` a point's position from W's origin, in W,
`v_WO` velocity of O in W, `f_FO_W` force of F on O expressed in W, `nhat_OF_W` a unit normal from O
into F. In a product the letters meet: X_WC = X_WO * X_OC. */

#include <Eigen/Geometry>
#include <cmath>

namespace graspbench {

using Pose = Eigen::Isometry3d;

inline Pose MakePose(const Eigen::Matrix3d& R_AB, const Eigen::Vector3d& p_AB) {
  Pose X_AB = Pose::Identity();
  X_AB.linear() = R_AB;
  X_AB.translation() = p_AB;
  return X_AB;
}
inline Pose MakePose(const Eigen::Vector3d& p_AB) {
  return MakePose(Eigen::Matrix3d::Identity(), p_AB);
}

/** Returns the rotation of fixed-axis roll (x), pitch (y) and yaw (z) [rad] in the convention of
URDF: R = Rz(yaw) Ry(pitch) Rx(roll). */
inline Eigen::Matrix3d MakeRotationRpy(double roll, double pitch, double yaw) {
  return (Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()) *
          Eigen::AngleAxisd(pitch, Eigen::Vector3d::UnitY()) *
          Eigen::AngleAxisd(roll, Eigen::Vector3d::UnitX()))
      .toRotationMatrix();
}

/** Returns roll, pitch and yaw [rad], the inverse of MakeRotationRpy. The angles are extracted one
after another, so that they stay exact at a pitch of 90 degrees. */
inline Eigen::Vector3d CalcRollPitchYaw(const Eigen::Matrix3d& R) {
  const double yaw = std::atan2(R(1, 0), R(0, 0));
  const Eigen::Matrix3d tilted = Eigen::AngleAxisd(-yaw, Eigen::Vector3d::UnitZ()) * R;
  return {std::atan2(-tilted(1, 2), tilted(1, 1)), std::atan2(-tilted(2, 0), tilted(0, 0)), yaw};
}

}  // namespace graspbench
