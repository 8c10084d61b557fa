#pragma once
/** @file
Scenes of a hand and an object, and cameras that show them.

Drawables point into the hand and the object they were made of, so a renderer uploads each mesh once
for all pictures of a study. */

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "core/arm/mounted_arm.h"
#include "core/hand/hand.h"
#include "core/render/scene.h"
#include "core/shape/grasp_object.h"

namespace graspbench {

/** The digits must be seen; palm and forearm may reach the picture's edge and fade away there.
@pre q has num_joints angles [rad]. */
void AddHand(const std::shared_ptr<const Hand>& hand, const Eigen::VectorXd& q, const Pose& X_WH,
             Scene* scene);
void AddObject(const std::shared_ptr<const GraspObject>& object, const Pose& X_WO, Scene* scene);
/** The capsules of a robot arm, which may fade away as the forearm. @param q  empty: nothing. */
void AddArm(const MountedArm* arm, const Eigen::VectorXd& q, Scene* scene);
/** Both of them, on the table. */
Scene MakeGraspScene(const std::shared_ptr<const Hand>& hand, const Eigen::VectorXd& q,
                     const Pose& X_WH, const std::shared_ptr<const GraspObject>& object,
                     const Pose& X_WO);

/** Unit vector in W towards a camera that sees the thumb and the finger next to it beside each
other: across the line between the ends of the two, a little above, with the root of the hand
behind. */
Eigen::Vector3d FindGraspView(const Hand& hand, const Eigen::VectorXd& q, const Pose& X_WH);

/** The nearest camera in direction `to_eye_W` whose picture of `aspect` (width / height) holds what
must be seen of all scenes, with a small margin: one camera for the pictures of a filmstrip.
@pre something must be seen; to_eye_W is not zero. */
Camera FrameScenes(const std::vector<Scene>& scenes, const Eigen::Vector3d& to_eye_W,
                   double aspect);

}  // namespace graspbench
