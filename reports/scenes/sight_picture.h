#pragma once
/** @file
A picture of a wrist camera with what was found in it. */

#include "core/vision/wrist_camera.h"
#include "reports/plots/svg_parts.h"

namespace graspbench {

inline constexpr double kSightWidth = 240.0;  ///< [px]; its height follows the camera's picture

/** The camera looks from above the supposed place, as in a trial's second look. Over its picture:
the outline that was seen, the smallest rectangle around it, O as a cross and the found direction
of the object's length as a line. Without them when nothing was found.
@param name  of the object, for title and description. */
Html DrawSight(WristCamera& camera, const GraspObject& object, const Pose& X_WO,
               const Eigen::VectorXd& q, const PlanarPose& supposed, const std::string& name);

}  // namespace graspbench
