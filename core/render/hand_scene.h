#pragma once
/** @file
Scenes of a hand and an object, and cameras that show them.

Drawables point into the hand and the object from which they were made, so a renderer uploads each
mesh once for all pictures of a study. */

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "core/arm/mounted_arm.h"
#include "core/hand/hand.h"
#include "core/render/scene.h"
#include "core/shape/grasp_object.h"

namespace graspbench {

/** Adds a hand. A framing camera must show its digits; palm and forearm may reach the edge of the
picture and fade there. @pre q has num_joints angles [rad]. */
void AddHand(const std::shared_ptr<const Hand>& hand, const Eigen::VectorXd& q, const Pose& X_WH,
             Scene* scene);
void AddObject(const std::shared_ptr<const GraspObject>& object, const Pose& X_WO, Scene* scene);
/** Adds the capsules of a robot arm. @param q  empty: adds nothing.
@param is_whole  a framing camera must show arm and hand whole; else both may fade at the edge. */
void AddArm(const MountedArm* arm, const Eigen::VectorXd& q, bool is_whole, Scene* scene);
/** Makes a scene of a hand and an object on the table. */
Scene MakeGraspScene(const std::shared_ptr<const Hand>& hand, const Eigen::VectorXd& q,
                     const Pose& X_WH, const std::shared_ptr<const GraspObject>& object,
                     const Pose& X_WO);

/** Returns the unit vector in W towards a camera that sees the thumb and the adjacent finger side
by side. It looks across the line between their ends, from slightly above, with the root of the hand
behind them. */
Eigen::Vector3d FindGraspView(const Hand& hand, const Eigen::VectorXd& q, const Pose& X_WH);

/** Returns the direction in W towards a camera that sees the whole arm from the side. */
Eigen::Vector3d FindArmView(const MountedArm& arm, const Pose& X_WH);

/** Returns the nearest camera in direction `to_eye_W` whose picture of `aspect` (width / height)
contains all required parts of all scenes, with a small margin: one camera for all pictures of a
filmstrip.
@pre some part is required; to_eye_W is not zero. */
Camera FrameScenes(const std::vector<Scene>& scenes, const Eigen::Vector3d& to_eye_W,
                   double aspect);

}  // namespace graspbench
