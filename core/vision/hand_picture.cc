#include "core/vision/hand_picture.h"

#include <algorithm>

#include "core/base/error.h"
#include "core/render/hand_scene.h"
#include "core/vision/picture_tools.h"

namespace graspbench {
namespace {

/** Each thread keeps one: shaders take longer to make than a trial's pictures. */
Renderer& FindHandRenderer(int size, RenderQuality quality) {
  struct Kept {
    int size = 0;
    RenderQuality quality = RenderQuality::kFast;
    std::unique_ptr<Renderer> renderer;
  };
  thread_local Kept kept;
  if (!kept.renderer || kept.size != size || kept.quality != quality) {
    kept = {size, quality, std::make_unique<Renderer>(size, size, quality)};
  }
  return *kept.renderer;
}

}  // namespace

Image TakeHandPicture(const std::shared_ptr<const Hand>& hand,
                      const std::shared_ptr<const GraspObject>& object, const CameraConfig& config,
                      int size, const Pose& X_WH, const Eigen::VectorXd& q, const Pose& X_WO,
                      uint64_t noise_seed) {
  if (!hand->camera) {
    throw Error(ErrorKind::kUnsupported, "the hand \"" + hand->id +
                                             "\" has no camera; leave out policy.picture_px, or "
                                             "add a camera to its hand.yaml");
  }
  const HandCamera& camera = *hand->camera;
  PinholeCamera pinhole;
  pinhole.X_WK = X_WH * CalcLinkPose(*hand, q, camera.link) * camera.X_LK;
  pinhole.focal_x = pinhole.focal_y =
      camera.focal_length * size / std::min(camera.width, camera.height);
  pinhole.centre_x = pinhole.centre_y = 0.5 * size;
  Scene scene;
  scene.has_grid = false;
  scene.table_srgb = ParseColour(config.table_colour).value();
  AddHand(hand, q, X_WH, &scene);
  AddObject(object, X_WO, &scene);
  PictureFaults faults;
  faults.width = faults.height = size;
  faults.blur = config.blur;
  faults.exposure = config.exposure;
  faults.noise = config.noise;
  faults.noise_seed = noise_seed;
  const RenderQuality quality = config.has_shadows ? RenderQuality::kFull : RenderQuality::kFast;
  return LoadPictureTools().apply_faults(FindHandRenderer(size, quality).Render(scene, pinhole),
                                         faults);
}

}  // namespace graspbench
