#pragma once
/** @file
Poses, vectors and inertias between Eigen and Simbody. */

#ifdef NDEBUG
#error "Debian's Simbody is built without NDEBUG; with it every program that uses it crashes."
#endif

#include <Simbody.h>

#include "core/base/pose.h"

namespace graspbench {

inline SimTK::Vec3 ToSimTK(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

inline SimTK::Transform ToSimTK(const Pose& X) {
  const Eigen::Matrix3d R = X.linear();
  const SimTK::Mat33 matrix(R(0, 0), R(0, 1), R(0, 2), R(1, 0), R(1, 1), R(1, 2), R(2, 0), R(2, 1),
                            R(2, 2));
  // `true`: the matrix is a rotation already, take it as it is.
  return {SimTK::Rotation(matrix, true), ToSimTK(Eigen::Vector3d(X.translation()))};
}

inline Eigen::Vector3d FromSimTK(const SimTK::Vec3& v) { return {v[0], v[1], v[2]}; }

inline Eigen::Matrix3d FromSimTK(const SimTK::Rotation& R) {
  Eigen::Matrix3d result;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) result(i, j) = R.asMat33()(i, j);
  }
  return result;
}

inline Pose FromSimTK(const SimTK::Transform& X) {
  return MakePose(FromSimTK(X.R()), FromSimTK(X.p()));
}

/** Of a body whose inertia `I_com` is about its centre of mass, in the axes of its frame. */
inline SimTK::MassProperties MakeMassProperties(double mass, const Eigen::Vector3d& p_com,
                                                const Eigen::Matrix3d& I_com) {
  const SimTK::Inertia central(I_com(0, 0), I_com(1, 1), I_com(2, 2), I_com(0, 1), I_com(0, 2),
                               I_com(1, 2));
  return {mass, ToSimTK(p_com), central.shiftFromMassCenter(ToSimTK(p_com), mass)};
}

}  // namespace graspbench
