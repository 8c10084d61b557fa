#pragma once
/** @file
Where a person wants to look from, in words: "front", "free AZIMUTH ELEVATION [ZOOM]". */

#include <Eigen/Core>
#include <string>
#include <vector>

#include "core/base/pose.h"
#include "core/base/units.h"
#include "core/hand/hand.h"
#include "core/render/scene.h"

namespace graspbench {

/** Without angles: across thumb and fingers, which move with the hand. */
struct SceneView {
  std::string name = "grasp";
  double azimuth_deg = kUnset;    ///< of the camera about z, from x
  double elevation_deg = kUnset;  ///< above the table
  double zoom = 1.0;              ///< 2: from half the distance
};

std::vector<std::string> ListSceneViews();

/** None: the grasp's own. @param help  where more is said, for messages: "help view".
@throws Error(kUsage) with suggestions, or naming the number and its range. */
SceneView ParseSceneView(const std::vector<std::string>& words, const std::string& help);

/** A camera that holds all of the scenes, seen by the view when the hand is as given. */
Camera PlaceCamera(const SceneView& view, const std::vector<Scene>& scenes, const Hand& hand,
                   const Eigen::VectorXd& q, const Pose& X_WH, double aspect);

}  // namespace graspbench
