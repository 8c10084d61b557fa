#pragma once
/** @file
Pictures from the camera of a hand during its motion: the central square of the lens's picture,
scaled and without distortion, with the noise, blur and exposure of the session's camera. */

#include <Eigen/Core>
#include <cstdint>
#include <memory>

#include "core/base/pose.h"
#include "core/hand/hand.h"
#include "core/render/scene.h"
#include "core/shape/grasp_object.h"
#include "core/vision/camera_config.h"

namespace graspbench {

/** Takes a picture.
@param size  side length of the picture [pixel].  @param q  the hand's joints (num_joints) [rad].
@throws Error(kEnvironment) if no picture can be made, Error(kUnsupported) for a hand without a
camera. @pre the configuration's colour is valid. */
Image TakeHandPicture(const std::shared_ptr<const Hand>& hand,
                      const std::shared_ptr<const GraspObject>& object, const CameraConfig& config,
                      int size, const Pose& X_WH, const Eigen::VectorXd& q, const Pose& X_WO,
                      uint64_t noise_seed);

}  // namespace graspbench
