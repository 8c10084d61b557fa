#pragma once
/** @file
Finds the object with the camera that the hand carries, while the hand comes to it.

Before the hand reaches its pre-grasp position the arm brings the camera over the place where the
object is supposed to be, looking straight down, with the picture's width along the object's
supposed length. There one picture is taken. Then the hand goes to where the object was seen and
turns along its main axis, and a second picture from there refines the first. From each place there
is a picture of the empty table, too, without noise: the mean of many; where neither hand nor
shadows are in it, it is the same everywhere and taken once. All of this is proposed by graspbench.
*/

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

/** The lens of a hand's camera. */
Lens MakeLens(const HandCamera& camera);

/** Not to be used by two threads at once. */
class WristCamera {
 public:
  /** @throws Error(kUnsupported) for a hand without a camera. @pre the configuration's colour is
  one. What takes a picture throws Error(kEnvironment) where none can be made. */
  WristCamera(std::shared_ptr<const Hand> hand, std::shared_ptr<const GraspObject> object,
              const CameraConfig& config);

  /** From the first to the second look, or to where the first one failed.
  @param X_WO  where the object really lies.
  @param q     of the hand's joints while it looks (num_joints) [rad].
  @param id    names the noise: the same gives the same pictures. */
  Sighting FindObject(const Pose& X_WO, const Eigen::VectorXd& q, std::string_view id);

  /** X_WK over an object at this pose. */
  Pose CalcLookPose(const PlanarPose& supposed) const;
  /** What the camera sees of the hand and, unless it is null, of the object. */
  Scene MakeScene(const Pose& X_WK, const Eigen::VectorXd& q, const Pose* X_WO) const;
  /** @param noise_seed  null: without noise. */
  Image TakePicture(const Scene& scene, const Pose& X_WK, const uint64_t* noise_seed);

  const Lens& lens() const { return lens_; }
  /** The perfect camera that the lens distorts, of which it shows a part. */
  PinholeCamera MakePinhole(const Pose& X_WK) const;

 private:
  struct VisualBall {
    Eigen::Vector3d p_LC;  // around a visual of the hand, in its link
    double radius;
  };
  /** Whether a part of the hand may be in the picture. @param scene  with the hand alone. */
  bool MaySeeHand(const Scene& scene, const Pose& X_WK) const;
  Sighting Look(const PlanarPose& supposed, const Pose& X_WO, const Eigen::VectorXd& q,
                uint64_t noise_seed);

  std::shared_ptr<const Hand> hand_;
  std::shared_ptr<const GraspObject> object_;
  CameraConfig config_;
  Eigen::Vector3f table_srgb_;
  Lens lens_;
  int margin_;  // by which the pinhole's picture is larger on each side [pixel]
  PictureFaults faults_;
  OutlineModel outline_;
  std::vector<VisualBall> balls_;    // of hand_->visuals
  std::optional<Image> bare_table_;  // without hand and shadows
};

}  // namespace graspbench
