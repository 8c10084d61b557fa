#pragma once
/** @file
Objects of a known shape to rehearse on. */

#include "core/base/pose.h"
#include "core/shape/grasp_object.h"
#include "core/shape/primitives.h"

namespace graspbench {

inline const Eigen::Vector3d kBar(0.15, 0.025, 0.04);

/** A bar of this size, its length at `yaw` from O's x. */
inline GraspObject MakeTurnedBar(const Eigen::Vector3d& size, double yaw) {
  GraspObject object;
  object.id = "bar";
  object.mesh = MakeRoundedBox(size, 0.001);
  for (Eigen::Vector3d& p : object.mesh.vertices) p = MakeRotationRpy(0.0, 0.0, yaw) * p;
  object.size = CalcBounds(object.mesh).sizes();
  object.mass_properties = CalcSolidMassProperties(object.mesh, 0.1);
  object.surface.friction_static = object.surface.friction_dynamic = 0.4;
  object.field =
      std::make_shared<const SignedDistanceField>(SignedDistanceField::Build(object.mesh));
  return object;
}

}  // namespace graspbench
