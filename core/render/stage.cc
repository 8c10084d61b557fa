#include "core/render/stage.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <string>

#include "core/base/error.h"

namespace graspbench {
namespace {

using Eigen::Matrix4d;
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kNear = 0.01;          // [m]
constexpr double kFar = 100.0;          // [m]
constexpr double kShadowMargin = 0.06;  // the widest penumbra around a shadow on the table [m]

}  // namespace

StageView MakeStageView(const Camera& camera, double aspect) {
  const Vector3d to_target = camera.p_WTarget - camera.p_WEye;
  const double distance = to_target.norm();
  GRASPBENCH_DEMAND(distance > 0.0 && camera.field_of_view > 0.0 && camera.field_of_view < M_PI,
                    "camera " + std::to_string(distance) + " m from its target, field of view " +
                        std::to_string(camera.field_of_view) + " rad");
  const Vector3d forward_W = to_target / distance;
  // Looking straight down there is no heading; the world's y is up in the picture then.
  const Vector2d level = forward_W.head<2>();
  const Vector2d heading = level.norm() > 1e-6 ? level.normalized() : Vector2d(0.0, 1.0);
  Eigen::Matrix3d R_WS = Eigen::Matrix3d::Identity();
  R_WS.col(0) = Vector3d(heading.y(), -heading.x(), 0.0);
  R_WS.col(1) = Vector3d(heading.x(), heading.y(), 0.0);

  StageView view;
  const Vector3d p_WS(camera.p_WTarget.x(), camera.p_WTarget.y(), 0.0);
  view.X_SW = MakePose(R_WS, p_WS).inverse();
  view.p_SEye = view.X_SW * camera.p_WEye;
  view.half_height = distance * std::tan(0.5 * camera.field_of_view);

  const Vector3d forward = R_WS.transpose() * forward_W;
  const Vector3d right = Vector3d::UnitX();  // of S, by its definition
  const Vector3d up = right.cross(forward);
  Matrix4d eye_from_S = Matrix4d::Identity();
  eye_from_S.block<1, 3>(0, 0) = right.transpose();
  eye_from_S.block<1, 3>(1, 0) = up.transpose();
  eye_from_S.block<1, 3>(2, 0) = -forward.transpose();
  eye_from_S.block<3, 1>(0, 3) = -eye_from_S.block<3, 3>(0, 0) * view.p_SEye;

  Matrix4d clip_from_eye = Matrix4d::Zero();
  clip_from_eye(1, 1) = 1.0 / std::tan(0.5 * camera.field_of_view);
  clip_from_eye(0, 0) = clip_from_eye(1, 1) / aspect;
  clip_from_eye(2, 2) = -(kFar + kNear) / (kFar - kNear);
  clip_from_eye(2, 3) = -2.0 * kFar * kNear / (kFar - kNear);
  clip_from_eye(3, 2) = -1.0;
  view.clip_from_S = clip_from_eye * eye_from_S;
  return view;
}

StageView MakeStageView(const PinholeCamera& camera, int width, int height) {
  GRASPBENCH_DEMAND(
      camera.focal_x > 0.0 && camera.focal_y > 0.0,
      "focal lengths " + std::to_string(camera.focal_x) + ", " + std::to_string(camera.focal_y));
  StageView view;
  view.p_SEye = camera.X_WK.translation();
  view.half_height = std::abs(view.p_SEye.z()) * 0.5 * height / camera.focal_y;
  view.fades_at_edges = false;

  Matrix4d clip_from_K = Matrix4d::Zero();
  clip_from_K(0, 0) = 2.0 * camera.focal_x / width;
  clip_from_K(0, 2) = 2.0 * camera.centre_x / width - 1.0;
  clip_from_K(1, 1) = -2.0 * camera.focal_y / height;
  clip_from_K(1, 2) = 1.0 - 2.0 * camera.centre_y / height;
  clip_from_K(2, 2) = (kFar + kNear) / (kFar - kNear);
  clip_from_K(2, 3) = -2.0 * kFar * kNear / (kFar - kNear);
  clip_from_K(3, 2) = 1.0;
  view.clip_from_S = clip_from_K * camera.X_WK.inverse().matrix();
  return view;
}

StageLight MakeStageLight(const Vector3d& to_light, const std::vector<Vector3d>& corners) {
  Eigen::Matrix3d R_LS;
  R_LS.row(2) = -to_light.transpose();
  R_LS.row(0) = Vector3d::UnitY().cross(to_light).normalized().transpose();
  R_LS.row(1) = R_LS.row(2).cross(R_LS.row(0));
  StageBox box;
  for (const Vector3d& p_S : corners) box.Add(R_LS * p_S);
  constexpr double kMapMargin = 0.004;  // no caster touches the map's border [m]
  box.lower.array() -= kMapMargin;
  box.upper.array() += kMapMargin;

  StageLight light;
  light.extent = box.upper - box.lower;
  const Vector3d scale = light.extent.cwiseInverse();
  light.map_from_S.topLeftCorner<3, 3>() = scale.asDiagonal() * R_LS;
  light.map_from_S.topRightCorner<3, 1>() = -scale.cwiseProduct(box.lower);
  return light;
}

Eigen::Vector4d FindShadowArea(const std::vector<Vector3d>& corners) {
  StageBox box;
  for (const Vector3d& p_S : corners) {
    box.Add(p_S);
    box.Add(p_S - std::max(p_S.z(), 0.0) / kToKey.z() * kToKey);
  }
  const Vector2d lower = box.lower.head<2>() - Vector2d::Constant(kShadowMargin);
  const Vector2d upper = box.upper.head<2>() + Vector2d::Constant(kShadowMargin);
  Eigen::Vector4d area;
  area << lower, upper - lower;
  return area;
}

}  // namespace graspbench
