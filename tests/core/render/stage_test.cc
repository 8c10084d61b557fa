#include "core/render/stage.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

namespace graspbench {
namespace {

using Eigen::Vector3d;
using Eigen::Vector4d;

Vector3d Project(const StageView& view, const Vector3d& p_W) {
  Vector4d p;
  p << view.X_SW * p_W, 1.0;
  const Vector4d clip = view.clip_from_S * p;
  return clip.head<3>() / clip.w();
}

TEST(StageTest, TheTargetIsTheMiddleAndTheEdgesAreThoseOfTheFieldOfView) {
  Camera camera;
  camera.p_WEye = Vector3d(0.3, -0.4, 0.2);
  camera.p_WTarget = Vector3d(0.0, 0.0, 0.2);  // level, so that z is up in the picture
  camera.field_of_view = 0.6;
  const StageView view = MakeStageView(camera, 1.5);
  EXPECT_LT(Project(view, camera.p_WTarget).head<2>().norm(), 1e-12);
  const double half = 0.5 * std::tan(0.3);  // at 0.5 m
  EXPECT_NEAR(view.half_height, half, 1e-12);
  EXPECT_NEAR(Project(view, Vector3d(0.0, 0.0, 0.2 + half)).y(), 1.0, 1e-12);
  const Vector3d right(0.8, 0.6, 0.0);
  EXPECT_NEAR(Project(view, camera.p_WTarget + 1.5 * half * right).x(), 1.0, 1e-12);
  // Origin below the target, y along the heading.
  EXPECT_LT((view.X_SW * Vector3d(0.0, 0.0, 0.0)).norm(), 1e-12);
  EXPECT_LT((view.X_SW * Vector3d(-0.6, 0.8, 0.0) - Vector3d::UnitY()).norm(), 1e-12);
}

TEST(StageTest, ALightMapHoldsItsCorners) {
  std::vector<Vector3d> corners;
  StageBox box;
  box.Add(Vector3d(-0.1, 0.0, 0.02));
  box.Add(Vector3d(0.2, 0.3, 0.4));
  for (int i = 0; i < 8; ++i) corners.push_back(box.Corner(i));
  for (const Vector3d& to_light : {kToKey, Vector3d(Vector3d::UnitZ())}) {
    const StageLight light = MakeStageLight(to_light, corners);
    for (const Vector3d& corner : corners) {
      const Vector3d p = (light.map_from_S * corner.homogeneous()).head<3>();
      EXPECT_GT(p.minCoeff(), 0.0);
      EXPECT_LT(p.maxCoeff(), 1.0);
      // Along the light only the depth changes, by the length of the box.
      const Vector3d q = (light.map_from_S * (corner - 0.05 * to_light).homogeneous()).head<3>();
      EXPECT_LT((q - p).head<2>().norm(), 1e-9);
      EXPECT_NEAR((q - p).z() * light.extent.z(), 0.05, 1e-12);
    }
  }
}

}  // namespace
}  // namespace graspbench
