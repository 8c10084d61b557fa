#pragma once
/** @file
Finds the object with the camera on the hand while the hand approaches it.

Before the hand reaches its pre-grasp position, the arm moves the camera above the supposed position
of the object. The camera looks straight down, with the picture's width along the object's supposed
length, and takes one picture. Then the hand moves to the observed position and turns along the
object's main axis, and a second picture from there refines the first. For each camera pose there is
also a noise-free picture of the empty table, the mean of many. If it shows neither hand nor
shadows, it is the same everywhere and is taken once. All of this is proposed by graspbench. */

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "core/hand/hand.h"
#include "core/render/scene.h"
#include "core/shape/grasp_object.h"
#include "core/vision/camera_config.h"
#include "core/vision/locate_object.h"
#include "core/vision/picture_tools.h"
#include "core/vision/silhouette.h"

namespace graspbench {

/** Returns the lens of a hand's camera. */
Lens MakeLens(const HandCamera& camera);

/** Two threads may not use it at once. */
class WristCamera {
 public:
  /** Methods that take a picture throw Error(kEnvironment) if none can be made.
  @throws Error(kUnsupported) for a hand without a camera.
  @pre the configuration's colour is valid. */
  WristCamera(std::shared_ptr<const Hand> hand, std::shared_ptr<const GraspObject> object,
              const CameraConfig& config);

  /** Takes both pictures. Returns the second sighting, or the first one if it failed.
  @param X_WO  true pose of the object.
  @param q     the hand's joints during the pictures (num_joints) [rad].
  @param id    names the noise: the same id gives the same pictures. */
  Sighting FindObject(const Pose& X_WO, const Eigen::VectorXd& q, std::string_view id);

  /** Returns X_WK above an object at this pose. */
  Pose CalcLookPose(const PlanarPose& supposed) const;
  /** Makes the scene of the hand and, unless X_WO is null, of the object. */
  Scene MakeScene(const Pose& X_WK, const Eigen::VectorXd& q, const Pose* X_WO) const;
  /** @param noise_seed  null: without noise. */
  Image TakePicture(const Scene& scene, const Pose& X_WK, const uint64_t* noise_seed);

  const Lens& lens() const { return lens_; }
  /** Returns the ideal camera that the lens distorts; the lens shows a part of its picture. */
  PinholeCamera MakePinhole(const Pose& X_WK) const;

 private:
  struct VisualBall {
    Eigen::Vector3d p_LC;  // centre of a ball around a visual of the hand, in its link
    double radius;
  };
  /** Returns whether a part of the hand may be in the picture. @param scene  with only the hand. */
  bool MaySeeHand(const Scene& scene, const Pose& X_WK) const;
  Sighting Look(const PlanarPose& supposed, const Pose& X_WO, const Eigen::VectorXd& q,
                uint64_t noise_seed);

  std::shared_ptr<const Hand> hand_;
  std::shared_ptr<const GraspObject> object_;
  CameraConfig config_;
  Eigen::Vector3f table_srgb_;
  Lens lens_;
  int margin_;  // extra size of the pinhole's picture on each side [pixel]
  PictureFaults faults_;
  OutlineModel outline_;
  std::vector<VisualBall> balls_;    // of hand_->visuals
  std::optional<Image> bare_table_;  // without hand and shadows
};

}  // namespace graspbench
