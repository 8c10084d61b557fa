#include "core/render/hand_scene.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/error.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;

constexpr double kElevation = 0.42;     // of the camera above the level [rad]
constexpr double kTowardsThumb = 0.45;  // from the line across the grip [rad]
constexpr double kMargin = 0.06;        // of half the picture, on each side

}  // namespace

void AddHand(const std::shared_ptr<const Hand>& hand, const Eigen::VectorXd& q, const Pose& X_WH,
             Scene* scene) {
  const std::vector<Pose> X_HL = CalcLinkPoses(*hand, q);
  for (const LinkVisual& visual : hand->visuals) {
    Drawable drawable;
    drawable.mesh = std::shared_ptr<const TriMesh>(hand, &visual.mesh);
    drawable.X_WM = X_WH * X_HL[visual.link];
    drawable.colour = visual.colour;
    drawable.must_be_seen = hand->FindDigitOfLink(visual.link) >= 0;
    scene->drawables.push_back(std::move(drawable));
  }
}

void AddObject(const std::shared_ptr<const GraspObject>& object, const Pose& X_WO, Scene* scene) {
  Drawable drawable;
  drawable.mesh = std::shared_ptr<const TriMesh>(object, &object->mesh);
  drawable.X_WM = X_WO;
  drawable.colour = object->colour;
  scene->drawables.push_back(std::move(drawable));
}

void AddArm(const MountedArm* arm, const Eigen::VectorXd& q, bool is_whole, Scene* scene) {
  if (!arm || q.size() == 0) return;
  const std::vector<Pose> X_BL = CalcArmPoses(*arm->arm, q);
  for (const ArmCapsule& capsule : arm->arm->capsules) {
    Drawable drawable;
    drawable.mesh = std::make_shared<const TriMesh>(MakeCapsuleMesh(capsule));
    drawable.X_WM = arm->X_WB * X_BL[static_cast<size_t>(capsule.link)];
    drawable.colour = kArmColour;
    drawable.must_be_seen = false;
    scene->drawables.push_back(std::move(drawable));
  }
  if (!is_whole) return;
  for (Drawable& drawable : scene->drawables) drawable.must_be_seen = true;
}

Scene MakeGraspScene(const std::shared_ptr<const Hand>& hand, const Eigen::VectorXd& q,
                     const Pose& X_WH, const std::shared_ptr<const GraspObject>& object,
                     const Pose& X_WO) {
  Scene scene;
  AddHand(hand, q, X_WH, &scene);
  AddObject(object, X_WO, &scene);
  return scene;
}

Vector3d FindGraspView(const Hand& hand, const Eigen::VectorXd& q, const Pose& X_WH) {
  const std::vector<Pose> X_HL = CalcLinkPoses(hand, q);
  const auto find_end = [&](const Digit& digit) -> Vector3d {  // tips may meet, last links do not
    return X_WH * X_HL[digit.distal_link].translation();
  };
  // The opposing pair: of all thumbs and fingers the two whose ends are nearest to each other.
  Vector3d thumb = X_WH * hand.p_HCentre;
  Vector3d finger = thumb;
  double nearest = std::numeric_limits<double>::infinity();
  for (const Digit& a : hand.digits) {
    for (const Digit& b : hand.digits) {
      const double distance = (find_end(a) - find_end(b)).norm();
      if (!a.is_thumb || b.is_thumb || distance >= nearest) continue;
      nearest = distance;
      thumb = find_end(a);
      finger = find_end(b);
    }
  }

  Vector3d to_thumb = thumb - finger;
  to_thumb.z() = 0.0;
  to_thumb = to_thumb.norm() > 1e-3 ? to_thumb.normalized() : Vector3d::UnitX();
  Vector3d across(-to_thumb.y(), to_thumb.x(), 0.0);
  const Vector3d p_WRoot = X_WH * X_HL[0].translation();
  if (across.dot(p_WRoot - 0.5 * (thumb + finger)) > 0.0) across = -across;
  const Vector3d level = std::cos(kTowardsThumb) * across + std::sin(kTowardsThumb) * to_thumb;
  return std::cos(kElevation) * level + std::sin(kElevation) * Vector3d::UnitZ();
}

Vector3d FindArmView(const MountedArm& arm, const Pose& X_WH) {
  Vector3d ahead_W = X_WH.translation() - arm.X_WB.translation();
  ahead_W.z() = 0.0;
  ahead_W = ahead_W.norm() > 1e-3 ? ahead_W.normalized() : Vector3d::UnitX();
  return Vector3d(0.4 * ahead_W.x() + ahead_W.y(), 0.4 * ahead_W.y() - ahead_W.x(), 0.3)
      .normalized();
}

Camera FrameScenes(const std::vector<Scene>& scenes, const Vector3d& to_eye_W, double aspect) {
  const Vector3d forward = -to_eye_W.normalized();
  Vector3d right = forward.cross(Vector3d::UnitZ());
  right = right.norm() > 1e-6 ? right.normalized() : Vector3d::UnitX();
  const Vector3d up = right.cross(forward);

  // With slope t of a side plane of the view, an eye at (x, y, depth) holds a point (px, py, pd)
  // between left and right if |px - x| <= t (pd - depth); up and down the same. So only the largest
  // of +-px - t pd count.
  Camera camera;
  const double slope_y = std::tan(0.5 * camera.field_of_view) * (1.0 - kMargin);
  const double slope_x = slope_y * aspect;
  double most_right, most_left, most_up, most_down;
  most_right = most_left = most_up = most_down = -std::numeric_limits<double>::infinity();
  double nearest = std::numeric_limits<double>::infinity();
  double farthest = -nearest;
  for (const Scene& scene : scenes) {
    for (const Drawable& drawable : scene.drawables) {
      if (!drawable.must_be_seen) continue;
      for (const Vector3d& p_M : drawable.mesh->vertices) {
        const Vector3d p_W = drawable.X_WM * p_M;
        const double x = p_W.dot(right);
        const double y = p_W.dot(up);
        const double depth = p_W.dot(forward);
        most_right = std::max(most_right, x - slope_x * depth);
        most_left = std::max(most_left, -x - slope_x * depth);
        most_up = std::max(most_up, y - slope_y * depth);
        most_down = std::max(most_down, -y - slope_y * depth);
        nearest = std::min(nearest, depth);
        farthest = std::max(farthest, depth);
      }
    }
  }
  GRASPBENCH_DEMAND(nearest <= farthest,
                    "nothing to see in " + std::to_string(scenes.size()) + " scenes");

  const double eye_depth =
      std::min(-0.5 * (most_right + most_left) / slope_x, -0.5 * (most_up + most_down) / slope_y);
  camera.p_WEye = 0.5 * (most_right - most_left) * right + 0.5 * (most_up - most_down) * up +
                  eye_depth * forward;
  camera.p_WTarget = camera.p_WEye + (0.5 * (nearest + farthest) - eye_depth) * forward;
  return camera;
}

}  // namespace graspbench
