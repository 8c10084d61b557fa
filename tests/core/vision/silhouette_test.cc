#include "core/vision/silhouette.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/random.h"
#include "core/base/units.h"
#include "core/shape/primitives.h"

namespace graspbench {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

// Of any points the farthest in each direction, by trying all; also of one alone and of a row.
TEST(SilhouetteTest, NoPointReachesFarther) {
  RandomStream random("silhouette", "points");
  std::vector<Vector2d> points;
  for (int i = 0; i < 500; ++i) {
    points.emplace_back(random.NextUniform(-0.1, 0.1), random.NextUniform(-0.1, 0.1));
    if (i % 7 == 0) points.push_back(points.front());
  }
  for (int i = 0; i < 20; ++i) points.emplace_back(0.15, -0.1 + 0.01 * i);
  for (const size_t count : {size_t{1}, size_t{2}, size_t{40}, points.size()}) {
    const std::vector<Vector2d> some(points.end() - static_cast<std::ptrdiff_t>(count),
                                     points.end());
    const Silhouette silhouette = MakeSilhouette(some);
    for (int i = 0; i < kNumDirections; ++i) {
      double farthest = -1.0;
      for (const Vector2d& p : some) farthest = std::max(farthest, p.dot(SilhouetteDirection(i)));
      ASSERT_NEAR(silhouette.reach[i], farthest, 1e-15) << count << " points, direction " << i;
    }
  }
}

// A ball's shadow from a point lamp is an ellipse: the cone of half-angle asin(r / distance) about
// the line to its centre, cut by the plane through the centre.
TEST(SilhouetteTest, ABallIsThrownAsTheConeAroundIt) {
  const double radius = 0.033;
  const OutlineModel ball(MakeSphere(radius, 192));
  EXPECT_NEAR(ball.middle(), radius, 1e-9);
  const PlanarPose pose{0.06, 0.0, 0.0};
  const Vector3d eye(0.0, 0.0, 0.4);
  const Silhouette thrown = ball.Throw(pose, eye);
  const double height = eye.z() - radius, theta = std::atan2(pose.x, height);
  const double alpha = std::asin(radius / std::hypot(pose.x, height));
  EXPECT_NEAR(thrown.reach[0], height * std::tan(theta + alpha), 5e-5);
  EXPECT_NEAR(-thrown.reach[kNumDirections / 2], height * std::tan(theta - alpha), 5e-5);
}

// A box below the eye: its upper face, enlarged.
TEST(SilhouetteTest, ABoxBelowTheEyeIsItsUpperFaceEnlarged) {
  const OutlineModel box(MakeRoundedBox(Vector3d(0.1, 0.04, 0.06), 0.0));
  const Silhouette thrown = box.Throw({0.0, 0.0, 0.3}, Vector3d(0.0, 0.0, 0.4));
  const double scale = (0.4 - 0.03) / (0.4 - 0.06);
  for (int i = 0; i < kNumDirections; ++i) {
    const double angle = 2.0 * kPi * i / kNumDirections - 0.3;
    EXPECT_NEAR(thrown.reach[i],
                scale * (0.05 * std::abs(std::cos(angle)) + 0.02 * std::abs(std::sin(angle))),
                1e-9);
  }
}

// The outline as seen may be thicker, which must not move it.
Silhouette Thicken(Silhouette silhouette, double by) {
  for (double& reach : silhouette.reach) reach += by;
  return silhouette;
}

// A wedge: one end is lower and narrower.
TriMesh MakeWedge() {
  TriMesh mesh = MakeRoundedBox(Vector3d(0.1, 0.04, 0.02), 0.0);
  for (Vector3d& p : mesh.vertices) {
    if (p.x() > 0.0) p.y() *= 0.4;
  }
  return mesh;
}

struct ShapeCase {
  const char* name;
  TriMesh mesh;
  KnownDirection known;
  double period;  // of turns that give the same outline [rad]
};

TEST(SilhouetteTest, FindsThePoseThatAnOutlineWasThrownFrom) {
  const ShapeCase cases[] = {
      {"wedge", MakeWedge(), KnownDirection::kFull, 2.0 * kPi},
      {"box", MakeRoundedBox(Vector3d(0.1, 0.04, 0.03), 0.0), KnownDirection::kHalfTurns, kPi},
      {"cube", MakeRoundedBox(Vector3d(0.04, 0.04, 0.04), 0.0), KnownDirection::kSeveral,
       0.5 * kPi},
      {"ball", MakeSphere(0.03, 192), KnownDirection::kNone, 0.0}};
  const Vector3d eye(0.01, -0.02, 0.4);
  RandomStream random("silhouette", "poses");
  for (const ShapeCase& shape : cases) {
    const OutlineModel model(shape.mesh);
    for (int i = 0; i < 20; ++i) {
      const PlanarPose pose{random.NextUniform(-0.04, 0.04), random.NextUniform(-0.04, 0.04),
                            random.NextUniform(-kPi, kPi)};
      const Silhouette seen = Thicken(model.Throw(pose, eye), 0.0004);
      const PlanarPose supposed{pose.x + 0.004, pose.y - 0.003, 0.0};
      const OutlineFit fit = FitOutline(seen, model, eye, supposed, 1e-4);
      EXPECT_EQ(fit.direction, shape.known) << shape.name;
      EXPECT_NEAR(fit.pose.x, pose.x, 1e-5) << shape.name;
      EXPECT_NEAR(fit.pose.y, pose.y, 1e-5) << shape.name;
      EXPECT_NEAR(fit.thickness, 0.0004, 2e-5) << shape.name;
      EXPECT_LT(fit.residual, 2e-5) << shape.name;
      if (shape.period > 0.0) {
        EXPECT_NEAR(std::remainder(fit.pose.yaw - pose.yaw, shape.period), 0.0, 1e-3) << shape.name;
        EXPECT_LE(std::abs(fit.pose.yaw), 0.5 * shape.period + 0.05) << shape.name;  // the nearest
      } else {
        EXPECT_EQ(fit.pose.yaw, 0.0);
      }
    }
  }
}

}  // namespace
}  // namespace graspbench
