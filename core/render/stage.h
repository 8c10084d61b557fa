#pragma once
/** @file
The stage frame S of a picture: origin on the table below the camera's target, z up, y along the
camera's heading. Defines the camera, the lights and the regions that they cover in S. */

#include <Eigen/Core>
#include <limits>
#include <vector>

#include "core/base/pose.h"
#include "core/render/scene.h"

namespace graspbench {

/** Unit directions in S towards distant lights: at the front left, at the right, behind the
scene. */
///@{
inline const Eigen::Vector3d kToKey = Eigen::Vector3d(-0.50, -0.42, 0.95).normalized();
inline const Eigen::Vector3d kToFill = Eigen::Vector3d(0.80, -0.55, 0.30).normalized();
inline const Eigen::Vector3d kToRim = Eigen::Vector3d(0.35, 0.90, 0.45).normalized();
///@}

/** Box with faces perpendicular to the axes of its frame. */
struct StageBox {
  Eigen::Vector3d lower = Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity());
  Eigen::Vector3d upper = Eigen::Vector3d::Constant(-std::numeric_limits<double>::infinity());

  void Add(const Eigen::Vector3d& p) {
    lower = lower.cwiseMin(p);
    upper = upper.cwiseMax(p);
  }
  /** @param i  0 to 7. */
  Eigen::Vector3d Corner(int i) const {
    return Eigen::Vector3d(i & 1 ? upper.x() : lower.x(), i & 2 ? upper.y() : lower.y(),
                           i & 4 ? upper.z() : lower.z());
  }
};

struct StageView {
  Pose X_SW = Pose::Identity();
  Eigen::Vector3d p_SEye = Eigen::Vector3d::Zero();
  Eigen::Matrix4d clip_from_S = Eigen::Matrix4d::Identity();
  double half_height = 0.0;    ///< half the picture's height at the target [m]
  bool fades_at_edges = true;  ///< drawables that the edges may cut fade there
};
/** @param aspect  width / height of the picture. */
StageView MakeStageView(const Camera& camera, double aspect);
/** Makes a view in which S is the world frame.
@param width, height  size of the picture [pixel]. */
StageView MakeStageView(const PinholeCamera& camera, int width, int height);

/** A light at infinity: a box in S that its map covers. */
struct StageLight {
  Eigen::Matrix4d map_from_S = Eigen::Matrix4d::Identity();  ///< to coordinates from 0 to 1
  Eigen::Vector3d extent = Eigen::Vector3d::Ones();          ///< of the box [m]
};
/** Makes a light whose map covers all of `corners` [m], in S. */
StageLight MakeStageLight(const Eigen::Vector3d& to_light,
                          const std::vector<Eigen::Vector3d>& corners);

/** Returns the part of the table that objects with these `corners` may shade: x, y of its corner,
length, width in S [m]. */
Eigen::Vector4d FindShadowArea(const std::vector<Eigen::Vector3d>& corners);

}  // namespace graspbench
