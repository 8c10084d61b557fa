#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "core/render/scene.h"
#include "core/shape/primitives.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;

constexpr int kWidth = 200, kHeight = 140;
constexpr int kBall = 0, kBox = 1;
const Vector3d kBallCentre(0.05, -0.02, 0.04);
constexpr double kBallRadius = 0.04;
const Vector3d kBoxSize(0.08, 0.03, 0.05);

// Rolled, oblique, its axis beside the picture's middle, its pixels no squares.
PinholeCamera MakeCamera() {
  PinholeCamera camera;
  camera.X_WK = MakePose(MakeRotationRpy(M_PI - 0.4, 0.25, 0.9), Vector3d(-0.07, 0.2, 0.4));
  camera.focal_x = 190.0;
  camera.focal_y = 230.0;
  camera.centre_x = 88.0;
  camera.centre_y = 81.0;
  return camera;
}

Pose MakeBoxPose() { return MakePose(MakeRotationRpy(0.2, 0.0, 0.5), Vector3d(-0.04, 0.05, 0.04)); }

Scene MakeScene() {
  Scene scene;
  Drawable ball, box;
  ball.mesh = std::make_shared<const TriMesh>(MakeSphere(kBallRadius, 128));
  ball.X_WM = MakePose(kBallCentre);
  ball.colour = Vector3f(0.6f, 0.05f, 0.05f);
  box.mesh = std::make_shared<const TriMesh>(MakeRoundedBox(kBoxSize, 0.0));
  box.X_WM = MakeBoxPose();
  box.colour = Vector3f(0.05f, 0.05f, 0.6f);
  scene.drawables = {ball, box};
  return scene;
}

struct Hit {
  int id = GeometryPicture::kNothing;
  double depth = 0.0;
};

// What the ray through a point of the picture meets first, by the equations of ball, box and plane.
// The ray has z = 1 in K, so that its parameter is the depth.
Hit CastRay(const PinholeCamera& camera, double u, double v) {
  const Vector3d ray_K((u - camera.centre_x) / camera.focal_x,
                       (v - camera.centre_y) / camera.focal_y, 1.0);
  const Vector3d ray = camera.X_WK.linear() * ray_K, eye = camera.X_WK.translation();
  Hit hit;
  const auto offer = [&](int id, double depth) {
    if (depth > 0.0 && (hit.id == GeometryPicture::kNothing || depth < hit.depth))
      hit = {id, depth};
  };
  offer(GeometryPicture::kTable, -eye.z() / ray.z());
  const Vector3d to_ball = kBallCentre - eye;
  const double along = ray.dot(to_ball) / ray.squaredNorm();
  const double inside = kBallRadius * kBallRadius - (to_ball - along * ray).squaredNorm();
  if (inside > 0.0) offer(kBall, along - std::sqrt(inside / ray.squaredNorm()));
  const Pose X_BW = MakeBoxPose().inverse();
  const Eigen::Array3d p = X_BW * eye, d = X_BW.linear() * ray, half = 0.5 * kBoxSize;
  const Eigen::Array3d a = (-half - p) / d, b = (half - p) / d;
  const double enter = a.min(b).maxCoeff();
  if (enter < a.max(b).minCoeff()) offer(kBox, enter);
  return hit;
}

TEST(PinholeCameraTest, EachPixelShowsWhatItsRayMeets) {
  const PinholeCamera camera = MakeCamera();
  Renderer renderer(kWidth, kHeight);
  const GeometryPicture picture = renderer.RenderGeometry(MakeScene(), camera);
  int num_wrong = 0, num_of[2] = {0, 0};
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const size_t pixel = static_cast<size_t>(y) * kWidth + x;
      const Hit hit = CastRay(camera, x + 0.5, y + 0.5);
      if (hit.id >= 0) ++num_of[hit.id];
      if (picture.id[pixel] != hit.id) {
        ++num_wrong;
      } else {
        // The ball is a polyhedron, 0.03 mm inside the ball; seen at its rim that counts more.
        ASSERT_NEAR(picture.depth[pixel], hit.depth, hit.id == kBall ? 2e-3 : 1e-5)
            << x << " " << y;
      }
    }
  }
  EXPECT_GT(num_of[kBall], 500);
  EXPECT_GT(num_of[kBox], 500);
  EXPECT_LE(num_wrong, 5);  // on outlines, where a ray decides by fractions of a pixel
}

// Red, blue or neither, away from outlines, as the rays say.
TEST(PinholeCameraTest, APictureShowsTheSameAsTheRays) {
  const PinholeCamera camera = MakeCamera();
  for (const RenderQuality quality : {RenderQuality::kFull, RenderQuality::kDraft}) {
    Renderer renderer(kWidth, kHeight, quality);
    const Image image = renderer.Render(MakeScene(), camera);
    int num_wrong = 0;
    for (int y = 1; y < kHeight - 1; ++y) {
      for (int x = 1; x < kWidth - 1; ++x) {
        const int id = CastRay(camera, x + 0.5, y + 0.5).id;
        bool is_outline = false;
        for (const auto& [du, dv] : {std::pair(-1, -1), {1, -1}, {-1, 1}, {1, 1}}) {
          is_outline |= CastRay(camera, x + 0.5 + du, y + 0.5 + dv).id != id;
        }
        if (is_outline) continue;
        const uint8_t* rgb = &image.rgb[3 * (static_cast<size_t>(y) * kWidth + x)];
        const int shown = rgb[0] > rgb[2] + 20   ? kBall
                          : rgb[2] > rgb[0] + 20 ? kBox
                                                 : GeometryPicture::kTable;
        num_wrong += shown != id;
      }
    }
    EXPECT_EQ(num_wrong, 0);
  }
}

TEST(PinholeCameraTest, TableAndBackgroundHaveTheirColours) {
  Scene scene;
  scene.table_srgb = Vector3f(0.7f, 0.2f, 0.6f);
  scene.background_srgb = Vector3f(0.1f, 0.3f, 0.2f);
  scene.has_grid = false;
  PinholeCamera camera;  // looks level along +y, over the table
  camera.X_WK = MakePose(MakeRotationRpy(-0.5 * M_PI, 0.0, 0.0), Vector3d(0.0, 0.0, 0.2));
  camera.centre_x = 0.5 * kWidth;
  camera.centre_y = 0.5 * kHeight;
  const Image image = Renderer(kWidth, kHeight).Render(scene, camera);
  const int rows[2] = {kHeight / 4, kHeight - 1};
  const Vector3f colours[2] = {scene.background_srgb, scene.table_srgb};
  for (int i = 0; i < 2; ++i) {
    for (int x = 0; x < kWidth; ++x) {  // no line anywhere
      for (int channel = 0; channel < 3; ++channel) {
        const uint8_t value = image.rgb[3 * (static_cast<size_t>(rows[i]) * kWidth + x) + channel];
        ASSERT_NEAR(value, 255.0f * colours[i][channel], 1.0f) << x;
      }
    }
  }
}

}  // namespace
}  // namespace graspbench
