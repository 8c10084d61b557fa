#pragma once
/** @file
Pictures of a wrist camera, with the detected object, and of tactile forces. */

#include <vector>

#include "core/hand/hand.h"
#include "core/vision/wrist_camera.h"
#include "reports/plots/svg_parts.h"

namespace graspbench {

inline constexpr double kSightWidth = 240.0;  ///< [px]; the height follows from the camera image

/** Draws the camera's view from above the assumed pose, as in a trial's second look. Overlays the
detected outline, its smallest enclosing rectangle, the origin of O as a cross, and the detected
direction of the object's length as a line. Without overlays when nothing was detected.
@param name  of the object, for title and description. */
Html DrawSight(WristCamera& camera, const GraspObject& object, const Pose& X_WO,
               const Eigen::VectorXd& q, const PlanarPose& supposed, const std::string& name);

/** Draws a hand from the palm's side, with its tactile elements as discs of their area. Discs are
shaded by force, with the number shown on hover. All joints are at zero. A disc is narrower the more
its element faces sideways.
@param force  of each element of the hand's skin [N]. */
Html DrawHandMap(const Hand& hand, const std::vector<double>& force, const PlotText& text);

}  // namespace graspbench
