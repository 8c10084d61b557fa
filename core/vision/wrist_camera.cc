#include "core/vision/wrist_camera.h"

#include <fmt/core.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/base/error.h"
#include "core/base/random.h"
#include "core/base/units.h"
#include "core/render/hand_scene.h"

namespace graspbench {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kRoomBelow = 0.05;  // between lens and object [m]

const HandCamera& FindCamera(const Hand& hand) {
  if (hand.camera) return *hand.camera;
  throw Error(ErrorKind::kUnsupported,
              "the hand \"" + hand.id +
                  "\" has no camera; add one to its hand.yaml (graspbench help hand.yaml), or "
                  "choose another positioning than camera");
}

/** Where the pinhole shows what the lens shows at a point of its picture [pixel]. */
Vector2d Undistort(const Lens& lens, const Vector2d& pixel) {
  const Vector3d ray = CalcRay(lens, pixel);
  return Vector2d(lens.focal_x * ray.x() + lens.centre_x, lens.focal_y * ray.y() + lens.centre_y);
}

/** How far beyond the edges of its own picture a lens sees: all of its edge is looked at. */
int FindMargin(const Lens& lens) {
  if (!lens.is_distorted()) return 0;
  double beyond = 0.0;
  const Vector2d size(lens.width, lens.height);
  const auto look_at = [&](double u, double v) {
    const Vector2d p = Undistort(lens, Vector2d(u, v));
    beyond = std::max({beyond, -p.minCoeff(), (p - size).maxCoeff()});
  };
  for (int u = 0; u <= lens.width; ++u) {
    look_at(u, 0.0);
    look_at(u, lens.height);
  }
  for (int v = 0; v <= lens.height; ++v) {
    look_at(0.0, v);
    look_at(lens.width, v);
  }
  return static_cast<int>(std::ceil(beyond)) + 1;
}

PictureFaults MakeFaults(const Lens& lens, int margin, const CameraConfig& config) {
  PictureFaults faults;
  faults.width = lens.width;
  faults.height = lens.height;
  faults.blur = config.blur;
  faults.exposure = config.exposure;
  if (!lens.is_distorted()) return faults;
  for (int y = 0; y < lens.height; ++y) {
    for (int x = 0; x < lens.width; ++x) {
      const Vector2d from = Undistort(lens, Vector2d(x + 0.5, y + 0.5));
      faults.from_x.push_back(static_cast<float>(from.x() + margin));
      faults.from_y.push_back(static_cast<float>(from.y() + margin));
    }
  }
  return faults;
}

RenderQuality ChooseQuality(const CameraConfig& config) {
  return config.has_shadows ? RenderQuality::kFull : RenderQuality::kFast;
}

/** Each pixel the mean of four: edges as a lens gives them, where smoothing alone would move them.
*/
Image HalveImage(const Image& fine) {
  Image image;
  image.width = fine.width / 2;
  image.height = fine.height / 2;
  image.rgb.resize(3 * static_cast<size_t>(image.width) * static_cast<size_t>(image.height));
  const auto row = 3 * static_cast<size_t>(fine.width);
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      for (size_t c = 0; c < 3; ++c) {
        const uint8_t* at =
            &fine.rgb[2 * static_cast<size_t>(y) * row + 6 * static_cast<size_t>(x) + c];
        const int sum = at[0] + at[3] + at[row] + at[row + 3];
        image.rgb[3 * (static_cast<size_t>(y) * static_cast<size_t>(image.width) +
                       static_cast<size_t>(x)) +
                  c] = static_cast<uint8_t>((sum + 2) / 4);
      }
    }
  }
  return image;
}

/** Each thread keeps one: shaders take longer to make than a session's pictures of an object. */
Renderer& FindRenderer(int width, int height, RenderQuality quality) {
  struct Kept {
    int width = 0, height = 0;
    RenderQuality quality = RenderQuality::kFast;
    std::unique_ptr<Renderer> renderer;
  };
  thread_local Kept kept;
  if (!kept.renderer || kept.width != width || kept.height != height || kept.quality != quality) {
    kept = {width, height, quality, std::make_unique<Renderer>(width, height, quality)};
  }
  return *kept.renderer;
}

}  // namespace

Lens MakeLens(const HandCamera& camera) {
  Lens lens;
  lens.width = camera.width;
  lens.height = camera.height;
  lens.focal_x = lens.focal_y = camera.focal_length;
  lens.centre_x = 0.5 * camera.width;
  lens.centre_y = 0.5 * camera.height;
  lens.k1 = camera.k1;
  lens.k2 = camera.k2;
  return lens;
}

WristCamera::WristCamera(std::shared_ptr<const Hand> hand,
                         std::shared_ptr<const GraspObject> object, const CameraConfig& config)
    : hand_(std::move(hand)),
      object_(std::move(object)),
      config_(config),
      table_srgb_(ParseColour(config.table_colour).value()),
      lens_(MakeLens(FindCamera(*hand_))),
      margin_(FindMargin(lens_)),
      faults_(MakeFaults(lens_, margin_, config)),
      outline_(object_->mesh) {
  for (const LinkVisual& visual : hand_->visuals) {
    Eigen::AlignedBox3d box;
    for (const Vector3d& p : visual.mesh.vertices) box.extend(p);
    if (box.isEmpty()) box.extend(Vector3d::Zero());
    balls_.push_back({box.center(), 0.5 * box.diagonal().norm()});
  }
}

bool WristCamera::MaySeeHand(const Scene& scene, const Pose& X_WK) const {
  const PinholeCamera camera = MakePinhole(X_WK);
  const double slope_x = camera.centre_x / camera.focal_x;  // the picture's middle is its centre
  const double slope_y = camera.centre_y / camera.focal_y;
  for (size_t i = 0; i < balls_.size(); ++i) {
    const Vector3d p_K = X_WK.inverse() * (scene.drawables[i].X_WM * balls_[i].p_LC);
    const auto is_beyond = [&](double side, double slope) {  // an edge of the picture
      return (std::abs(side) - slope * p_K.z()) / std::hypot(1.0, slope) > balls_[i].radius;
    };
    const bool is_outside =
        p_K.z() < -balls_[i].radius || is_beyond(p_K.x(), slope_x) || is_beyond(p_K.y(), slope_y);
    if (!is_outside) return true;
  }
  return false;
}

PinholeCamera WristCamera::MakePinhole(const Pose& X_WK) const {
  PinholeCamera camera;
  camera.X_WK = X_WK;
  camera.focal_x = lens_.focal_x;
  camera.focal_y = lens_.focal_y;
  camera.centre_x = lens_.centre_x + margin_;
  camera.centre_y = lens_.centre_y + margin_;
  return camera;
}

Pose WristCamera::CalcLookPose(const PlanarPose& supposed) const {
  const double c = std::cos(supposed.yaw), s = std::sin(supposed.yaw);
  Eigen::Matrix3d R_WK;
  R_WK << c, s, 0.0,  //
      s, -c, 0.0,     //
      0.0, 0.0, -1.0;
  return MakePose(R_WK, Vector3d(supposed.x, supposed.y, config_.look_height));
}

Scene WristCamera::MakeScene(const Pose& X_WK, const Eigen::VectorXd& q, const Pose* X_WO) const {
  Scene scene;
  scene.has_grid = false;
  scene.table_srgb = table_srgb_;
  const Pose X_HK = CalcLinkPose(*hand_, q, hand_->camera->link) * hand_->camera->X_LK;
  AddHand(hand_, q, X_WK * X_HK.inverse(), &scene);
  if (X_WO) AddObject(object_, *X_WO, &scene);
  return scene;
}

Image WristCamera::TakePicture(const Scene& scene, const Pose& X_WK, const uint64_t* noise_seed) {
  PictureFaults& faults = faults_;
  faults.noise = noise_seed ? config_.noise : 0.0;
  faults.noise_seed = noise_seed ? *noise_seed : 0;
  const int scale = config_.has_shadows ? 2 : 1;
  PinholeCamera pinhole = MakePinhole(X_WK);
  for (double* length :
       {&pinhole.focal_x, &pinhole.focal_y, &pinhole.centre_x, &pinhole.centre_y}) {
    *length *= scale;
  }
  Renderer& renderer = FindRenderer(scale * (lens_.width + 2 * margin_),
                                    scale * (lens_.height + 2 * margin_), ChooseQuality(config_));
  const Image picture = renderer.Render(scene, pinhole);
  return LoadPictureTools().apply_faults(scale == 1 ? picture : HalveImage(picture), faults);
}

Sighting WristCamera::Look(const PlanarPose& supposed, const Pose& X_WO, const Eigen::VectorXd& q,
                           uint64_t noise_seed) {
  const Pose X_WK = CalcLookPose(supposed);
  Scene scene = MakeScene(X_WK, q, nullptr);
  Image own_table;
  const Image* empty_table = &own_table;
  if (config_.has_shadows || MaySeeHand(scene, X_WK)) {
    own_table = TakePicture(scene, X_WK, nullptr);
  } else {
    scene.drawables.clear();
    if (!bare_table_) bare_table_ = TakePicture(scene, X_WK, nullptr);
    empty_table = &*bare_table_;
  }
  AddObject(object_, X_WO, &scene);
  const Image picture = TakePicture(scene, X_WK, &noise_seed);
  return LocateObject(picture, *empty_table, lens_, X_WK, outline_, supposed);
}

Sighting WristCamera::FindObject(const Pose& X_WO, const Eigen::VectorXd& q, std::string_view id) {
  if (outline_.height() + kRoomBelow > config_.look_height) {
    Sighting sighting;
    sighting.reason =
        fmt::format("the camera looks from {:.0f} mm above the table; the object is {:.0f} mm high",
                    MmFromM(config_.look_height), MmFromM(outline_.height()));
    return sighting;
  }
  RandomStream noise(id, "camera noise");
  const Sighting first = Look(PlanarPose(), X_WO, q, noise.NextBits());
  if (!first.is_found) return first;
  return Look(first.pose, X_WO, q, noise.NextBits());
}

}  // namespace graspbench
