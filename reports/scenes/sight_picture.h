#pragma once
/** @file
A picture of a wrist camera with what was found in it. */

#include <vector>

#include "core/hand/hand.h"
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

/** A hand seen from its palm's side, its tactile elements as discs of their area.
Shaded by force, with the number where it is pointed at. All joints at zero, thumb and fingers as
they then lie; a disc is narrower the more its element faces sideways.
@param force  of each element of the hand's skin [N]. */
Html DrawHandMap(const Hand& hand, const std::vector<double>& force, const PlotText& text);

}  // namespace graspbench
