#pragma once
/** @file
How far a point is from the surface of the object, for objects that a study describes in a line and
for those of the catalogue.

All are in frame O [m], positive outside, negative inside. O is the centre of the solid; z is up as
the object rests (core/base/pose.h). */

#include <Eigen/Core>
#include <functional>
#include <memory>

#include "core/shape/signed_distance_field.h"

namespace graspbench {

using SurfaceDistance = std::function<double(const Eigen::Vector3d& p_O)>;

/** @pre radius > 0. */
SurfaceDistance MakeSphereDistance(double radius);
/** Axis z. @pre both > 0. */
SurfaceDistance MakeCylinderDistance(double radius, double height);
/** @param size  length, width, height, each > 0. */
SurfaceDistance MakeBoxDistance(const Eigen::Vector3d& size);
/** Any closed mesh. Farther than SignedDistanceField::kMargin away it is a lower bound, which no
rule here minds. */
SurfaceDistance MakeFieldDistance(std::shared_ptr<const SignedDistanceField> field);

}  // namespace graspbench
