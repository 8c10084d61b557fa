#pragma once
/** @file
Conversion of poses, vectors, inertias and links between this program and Simbody. */

#ifdef NDEBUG
#error "Debian's Simbody is built without NDEBUG; with it every program that uses it crashes."
#endif

#include <Simbody.h>

#include "core/base/pose.h"
#include "core/hand/hand.h"

namespace graspbench {

inline SimTK::Vec3 ToSimTK(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

inline SimTK::Transform ToSimTK(const Pose& X) {
  const Eigen::Matrix3d R = X.linear();
  const SimTK::Mat33 matrix(R(0, 0), R(0, 1), R(0, 2), R(1, 0), R(1, 1), R(1, 2), R(2, 0), R(2, 1),
                            R(2, 2));
  // `true`: the matrix already is a rotation and is used unchanged.
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

/** Makes the mass properties of a body whose inertia `I_com` is about its centre of mass, in the
axes of its frame. */
inline SimTK::MassProperties MakeMassProperties(double mass, const Eigen::Vector3d& p_com,
                                                const Eigen::Matrix3d& I_com) {
  const SimTK::Inertia central(I_com(0, 0), I_com(1, 1), I_com(2, 2), I_com(0, 1), I_com(0, 2),
                               I_com(1, 2));
  return {mass, ToSimTK(p_com), central.shiftFromMassCenter(ToSimTK(p_com), mass)};
}

/** Adds a link to its parent: welded, or with a joint that turns about or slides along the link's
axis.
@pre the link has a parent. */
inline SimTK::MobilizedBody AddLink(const Hand& hand, const HandLink& link,
                                    SimTK::MobilizedBody& parent, const SimTK::Body& body) {
  const SimTK::Transform X_PJ = ToSimTK(link.X_PJ);
  if (link.joint < 0) {
    return SimTK::MobilizedBody::Weld(parent, X_PJ, body, SimTK::Transform());
  }
  // Aligns Simbody's joint axis (x of a slider, z of a pin) with that of the link.
  const bool slides = hand.joints[static_cast<size_t>(link.joint)].is_prismatic;
  const SimTK::Transform X_LM(SimTK::Rotation(
      SimTK::UnitVec3(ToSimTK(link.axis)),
      slides ? SimTK::CoordinateAxis(SimTK::XAxis) : SimTK::CoordinateAxis(SimTK::ZAxis)));
  if (slides) return SimTK::MobilizedBody::Slider(parent, X_PJ * X_LM, body, X_LM);
  return SimTK::MobilizedBody::Pin(parent, X_PJ * X_LM, body, X_LM);
}

}  // namespace graspbench
