#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

#include "core/base/error.h"
#include "core/render/scene.h"
#include "core/shape/primitives.h"

namespace graspbench {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr int kPictureWidth = 240;
constexpr int kPictureHeight = 180;
constexpr int kBackground[3] = {237, 238, 240};  // sRGB, as scene.h promises

// The pinhole camera written down once more, as the truth for the pictures: pixel (u, v) with v
// downwards, pixel centres at half integers.
struct Pinhole {
  explicit Pinhole(const Camera& camera) : p_WEye(camera.p_WEye) {
    forward = (camera.p_WTarget - camera.p_WEye).normalized();
    right = forward.cross(Vector3d::UnitZ()).normalized();
    down = forward.cross(right);
    focal_length = 0.5 * kPictureHeight / std::tan(0.5 * camera.field_of_view);
  }
  Vector2d Project(const Vector3d& p_W) const {
    const Vector3d p = p_W - p_WEye;
    return Vector2d(0.5 * kPictureWidth + focal_length * p.dot(right) / p.dot(forward),
                    0.5 * kPictureHeight + focal_length * p.dot(down) / p.dot(forward));
  }
  Vector3d CalcRay(double u, double v) const {
    return (forward + (u - 0.5 * kPictureWidth) / focal_length * right +
            (v - 0.5 * kPictureHeight) / focal_length * down)
        .normalized();
  }
  Vector3d p_WEye, forward, right, down;
  double focal_length = 0.0;
};

const uint8_t* FindPixel(const Image& image, int u, int v) {
  return &image.rgb[3 * (static_cast<size_t>(v) * image.width + u)];
}

bool IsBackground(const Image& image, int u, int v) {
  return std::equal(kBackground, kBackground + 3, FindPixel(image, u, v));
}

int CalcBrightness(const Image& image, const Vector2d& pixel) {
  const uint8_t* rgb = FindPixel(image, static_cast<int>(pixel.x()), static_cast<int>(pixel.y()));
  return rgb[0] + rgb[1] + rgb[2];
}

// How far from an outline a pixel may differ from what rays say: where edges are as they come, and
// where they are smoothed by up to two pixels along and half a pixel across.
constexpr double kReach = 0.75, kSmoothReach = 3.0;

// Making one compiles the shaders, so most tests share it.
Renderer& SharedRenderer() {
  static Renderer renderer(kPictureWidth, kPictureHeight);
  return renderer;
}

// Edges as they come.
Renderer& SharedFastRenderer() {
  static Renderer renderer(kPictureWidth, kPictureHeight, RenderQuality::kFast);
  return renderer;
}

// Pixels that differ from what rays say, farther from the outline than `reach`.
int CountWrongPixels(const Image& image, const Camera& camera, double reach,
                     const std::function<bool(const Vector3d& p_W, const Vector3d& ray_W)>& hits) {
  const Pinhole pinhole(camera);
  int num_wrong = 0;
  for (int v = 0; v < kPictureHeight; ++v) {
    for (int u = 0; u < kPictureWidth; ++u) {
      int num_hits = 0;
      for (const double du : {-1.0, -1.0 / 3.0, 1.0 / 3.0, 1.0}) {
        for (const double dv : {-1.0, -1.0 / 3.0, 1.0 / 3.0, 1.0}) {
          num_hits +=
              hits(pinhole.p_WEye, pinhole.CalcRay(u + 0.5 + reach * du, v + 0.5 + reach * dv));
        }
      }
      if (num_hits % 16 != 0) continue;
      if (IsBackground(image, u, v) != (num_hits == 0)) ++num_wrong;
    }
  }
  return num_wrong;
}

Drawable MakeDrawable(TriMesh mesh, const Pose& X_WM, const Eigen::Vector3f& colour) {
  Drawable drawable;
  drawable.mesh = std::make_shared<const TriMesh>(std::move(mesh));
  drawable.X_WM = X_WM;
  drawable.colour = colour;
  return drawable;
}

const Eigen::Vector3f kRed(0.7f, 0.05f, 0.05f);
const Eigen::Vector3f kGreen(0.05f, 0.6f, 0.05f);

// A tall box and a ball on the table.
Scene MakeStillLife(const Pose& X_WS) {
  Scene scene;
  scene.drawables.push_back(MakeDrawable(MakeRoundedBox(Vector3d(0.04, 0.04, 0.1), 0.0),
                                         X_WS * MakePose(Vector3d(0.0, 0.0, 0.05)), kRed));
  scene.drawables.push_back(
      MakeDrawable(MakeSphere(0.02), X_WS * MakePose(Vector3d(0.06, -0.02, 0.02)), kGreen));
  return scene;
}

TEST(RendererTest, SphereFillsThePixelsOfItsProjection) {
  const Vector3d centre(0.05, 0.03, 0.08);
  const double radius = 0.03;
  Scene scene;
  scene.has_table = false;
  scene.drawables.push_back(MakeDrawable(MakeSphere(radius, 256), MakePose(centre), kRed));
  const Camera camera;
  const Image image = SharedFastRenderer().Render(scene, camera);
  const auto hits = [&](const Vector3d& p_W, const Vector3d& ray_W) {
    return (centre - p_W).cross(ray_W).norm() < radius;
  };
  EXPECT_EQ(CountWrongPixels(image, camera, kReach, hits), 0);
  EXPECT_EQ(CountWrongPixels(SharedRenderer().Render(scene, camera), camera, kSmoothReach, hits),
            0);

  // The outline is an ellipse: the cone of half-angle alpha about the ray to the centre, cut by the
  // image plane.
  const Pinhole pinhole(camera);
  const Vector3d to_centre = centre - pinhole.p_WEye;
  const double alpha = std::asin(radius / to_centre.norm());
  const double theta = std::acos(to_centre.normalized().dot(pinhole.forward));
  const double a = 0.5 * (std::tan(theta + alpha) - std::tan(theta - alpha));
  const double middle = 0.5 * (std::tan(theta + alpha) + std::tan(theta - alpha));
  const double b = std::sqrt(std::pow(middle * std::sin(theta) + std::cos(theta), 2.0) /
                                 std::pow(std::cos(alpha), 2.0) -
                             middle * middle - 1.0);
  const double f = pinhole.focal_length;
  const Vector2d principal(0.5 * kPictureWidth, 0.5 * kPictureHeight);
  const Vector2d expected_centre =
      principal + f * middle * (pinhole.Project(centre) - principal).normalized();
  double area = 0.0;
  Vector2d sum = Vector2d::Zero();
  for (int v = 0; v < kPictureHeight; ++v) {
    for (int u = 0; u < kPictureWidth; ++u) {
      if (IsBackground(image, u, v)) continue;
      area += 1.0;
      sum += Vector2d(u + 0.5, v + 0.5);
    }
  }
  EXPECT_NEAR(area, M_PI * f * a * f * b, 0.01 * area);
  EXPECT_LT((sum / area - expected_centre).norm(), 0.1);
}

TEST(RendererTest, CubeFillsThePixelsThatRaysHit) {
  Scene scene;
  scene.has_table = false;
  const Matrix3d R_WM = MakeRotationRpy(0.3, 0.2, 0.9);
  scene.drawables.push_back(
      MakeDrawable(MakeRoundedBox(Vector3d::Ones(), 0.0), MakePose(R_WM, Vector3d::Zero()), kRed));
  Camera camera;
  camera.p_WEye = Vector3d(2.0, -3.0, 1.5);
  camera.p_WTarget = Vector3d(0.2, 0.1, 0.0);
  const auto hits = [&](const Vector3d& p_W, const Vector3d& ray_W) {
    const Vector3d p = R_WM.transpose() * p_W;
    const Eigen::Array3d ray = R_WM.transpose() * ray_W;
    const Eigen::Array3d t0 = (-0.5 - p.array()) / ray;
    const Eigen::Array3d t1 = (0.5 - p.array()) / ray;
    return t0.min(t1).maxCoeff() < t0.max(t1).minCoeff();
  };
  // Vertices are snapped to fractions of a pixel, which may decide a sample on the outline.
  EXPECT_LE(CountWrongPixels(SharedFastRenderer().Render(scene, camera), camera, kReach, hits), 2);
  EXPECT_LE(CountWrongPixels(SharedRenderer().Render(scene, camera), camera, kSmoothReach, hits),
            2);
}

// Off the grid's lines, which run through multiples of 50 mm.
TEST(RendererTest, ShadowLiesAwayFromTheKeyLight) {
  Camera camera;  // looks along +y; the key light comes from the left before the scene
  camera.p_WEye = Vector3d(0.02, -0.4, 0.5);
  camera.p_WTarget = Vector3d(0.02, 0.0, 0.0);
  const Pose X_WS = MakePose(Vector3d(0.02, 0.0, 0.0));
  const Image image = SharedRenderer().Render(MakeStillLife(X_WS), camera);
  const Pinhole pinhole(camera);
  const auto brightness_at = [&](double x, double y) {
    return CalcBrightness(image, pinhole.Project(Vector3d(0.02 + x, y, 0.0)));
  };
  const int lit = kBackground[0] + kBackground[1] + kBackground[2];
  EXPECT_LT(brightness_at(0.04, 0.035), lit - 60);
  EXPECT_GT(brightness_at(-0.06, -0.055), lit - 20);
  EXPECT_NEAR(brightness_at(-0.135, -0.085), lit, 3);
}

/** Of what is darker than the table, in shares of the picture. */
Vector2d FindMiddleOfDarkness(const Image& image) {
  const int lit = kBackground[0] + kBackground[1] + kBackground[2];
  Vector2d sum = Vector2d::Zero();
  double darkness = 0.0;
  for (int v = 0; v < image.height; ++v) {
    for (int u = 0; u < image.width; ++u) {
      const double dark = lit - CalcBrightness(image, Vector2d(u, v));
      sum += dark * Vector2d((u + 0.5) / image.width, (v + 0.5) / image.height);
      darkness += dark;
    }
  }
  return sum / darkness;
}

// Also where a row of the shadow's texels is no multiple of four bytes.
TEST(RendererTest, ShadowHasItsPlaceAtEverySize) {
  Camera camera;
  camera.p_WEye = Vector3d(0.0, -0.4, 0.5);
  camera.p_WTarget = Vector3d::Zero();
  Scene scene = MakeStillLife(Pose::Identity());
  scene.has_grid = false;
  const Vector2d middle = FindMiddleOfDarkness(Renderer(512, 512).Render(scene, camera));
  for (const int size : {500, 508}) {
    const Vector2d other = FindMiddleOfDarkness(Renderer(size, size).Render(scene, camera));
    EXPECT_LT((other - middle).norm(), 0.002) << size << ": " << (other - middle).transpose();
  }
}

TEST(RendererTest, SameSceneGivesSameBytes) {
  const Scene scene = MakeStillLife(Pose::Identity());
  Renderer& renderer = SharedRenderer();
  const Image first = renderer.Render(scene, Camera());
  renderer.Render(MakeStillLife(MakePose(Vector3d(0.1, 0.0, 0.0))), Camera());
  EXPECT_EQ(renderer.Render(scene, Camera()).rgb, first.rgb);
  EXPECT_EQ(Renderer(kPictureWidth, kPictureHeight).Render(scene, Camera()).rgb, first.rgb);
}

// The picture tells where the camera stands relative to the scene, not where both are.
TEST(RendererTest, MovingCameraAndSceneTogetherChangesNothing) {
  const Scene scene = MakeStillLife(Pose::Identity());
  const Camera camera;
  Renderer& renderer = SharedRenderer();
  const Image reference = renderer.Render(scene, camera);
  // By the grid's spacing and a quarter turn, so that its lines fall onto themselves.
  const Pose X_WS = MakePose(MakeRotationRpy(0.0, 0.0, 0.5 * M_PI), Vector3d(0.25, -0.6, 0.0));
  Camera moved_camera = camera;
  moved_camera.p_WEye = X_WS * camera.p_WEye;
  moved_camera.p_WTarget = X_WS * camera.p_WTarget;
  const Image moved = renderer.Render(MakeStillLife(X_WS), moved_camera);
  int num_different = 0;
  for (size_t i = 0; i < reference.rgb.size(); ++i) {
    num_different += std::abs(reference.rgb[i] - moved.rgb[i]) > 2;
  }
  EXPECT_LT(num_different, 0.001 * reference.rgb.size());
  EXPECT_NE(renderer.Render(MakeStillLife(X_WS), camera).rgb, reference.rgb);
}

// A new mesh may take the address of a dead one; the picture must not show the dead one.
TEST(RendererTest, MeshAtTheAddressOfADeadOneIsDrawnAfresh) {
  Renderer& renderer = SharedRenderer();
  const Pose X_WM = MakePose(Vector3d(0.0, 0.0, 0.06));
  TriMesh mesh;
  for (const double radius : {0.02, 0.05, 0.03}) {
    mesh = MakeSphere(radius);
    Scene scene;
    scene.drawables.push_back(MakeDrawable({}, X_WM, kRed));
    // Owned until the end of this turn, always at the same address.
    scene.drawables[0].mesh = std::shared_ptr<const TriMesh>(std::make_shared<const int>(0), &mesh);
    Scene expected;
    expected.drawables.push_back(MakeDrawable(mesh, X_WM, kRed));
    EXPECT_EQ(renderer.Render(scene, Camera()).rgb, renderer.Render(expected, Camera()).rgb)
        << radius;
  }
}

// A pixel shows the thing or the table as in full quality, but for the outlines; the table is lit
// everywhere.
TEST(RendererTest, DraftShowsTheSameThingsWithoutShadows) {
  Scene scene;
  scene.drawables.push_back({std::make_shared<TriMesh>(MakeSphere(0.03, 192)),
                             MakePose(Matrix3d::Identity(), Vector3d(0.0, 0.0, 0.08))});
  ASSERT_GT(scene.drawables[0].mesh->num_triangles(), 30000);
  scene.drawables[0].colour = Eigen::Vector3f(0.7f, 0.05f, 0.05f);
  const Camera camera;
  Renderer draft(kPictureWidth, kPictureHeight, RenderQuality::kDraft);
  const Image full = SharedRenderer().Render(scene, camera), fast = draft.Render(scene, camera);
  const auto is_red = [](const Image& image, int u, int v) {
    const uint8_t* rgb = FindPixel(image, u, v);
    return rgb[0] > rgb[1] + 20;
  };
  int num_different = 0, num_red = 0, num_dark = 0;
  for (int v = 0; v < kPictureHeight; ++v) {
    for (int u = 0; u < kPictureWidth; ++u) {
      num_red += is_red(full, u, v);
      num_different += is_red(full, u, v) != is_red(fast, u, v);
      num_dark += !is_red(fast, u, v) && !is_red(full, u, v) && FindPixel(fast, u, v)[0] < 170;
    }
  }
  EXPECT_GT(num_red, 500);
  EXPECT_LT(num_different, num_red / 20);  // an outline of some 90 pixels
  EXPECT_EQ(num_dark, 0);
  EXPECT_EQ(draft.Render(scene, camera).rgb, fast.rgb);
}

TEST(RendererTest, RefusesImpossibleSizes) {
  for (const auto& [width, height] : {std::pair(0, 10), std::pair(10, 5000)}) {
    try {
      Renderer renderer(width, height);
      FAIL() << "no error";
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::kRange);
      EXPECT_EQ(std::string(error.what()), "a picture of " + std::to_string(width) + " x " +
                                               std::to_string(height) +
                                               " pixels; expected 1 to 4096 on each side");
    }
  }
}

// A wall that fills the picture: what need not be seen ends at the edge in the background's colour.
TEST(Renderer, WhatMayBeCutFadesTowardsTheEdge) {
  Scene scene;
  scene.has_table = false;
  scene.drawables.emplace_back();
  scene.drawables[0].mesh =
      std::make_shared<const TriMesh>(MakeRoundedBox(Vector3d(4.0, 0.2, 4.0), 0.01));
  scene.drawables[0].colour = Eigen::Vector3f(0.1f, 0.1f, 0.1f);
  Camera camera;
  camera.p_WEye = Vector3d(0.0, -1.0, 0.0);
  camera.p_WTarget = Vector3d::Zero();
  const Image cut = SharedRenderer().Render(scene, camera);
  scene.drawables[0].must_be_seen = false;
  const Image faded = SharedRenderer().Render(scene, camera);
  const Vector2d middle(0.5 * kPictureWidth, 0.5 * kPictureHeight);
  EXPECT_EQ(CalcBrightness(faded, middle), CalcBrightness(cut, middle));
  const int background = kBackground[0] + kBackground[1] + kBackground[2];
  int last = CalcBrightness(faded, middle);
  for (const double share : {0.08, 0.05, 0.02, 0.0}) {  // towards the left edge
    const Vector2d pixel(share * kPictureWidth, 0.5 * kPictureHeight);
    const int brightness = CalcBrightness(faded, pixel);
    EXPECT_GT(brightness, last) << share;
    EXPECT_LT(CalcBrightness(cut, pixel), background / 2);
    last = brightness;
  }
  EXPECT_NEAR(last, background, 6);
}

using Eigen::Vector3f;

constexpr int kSceneWidth = 200, kSceneHeight = 140;
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
  Renderer renderer(kSceneWidth, kSceneHeight);
  const GeometryPicture picture = renderer.RenderGeometry(MakeScene(), camera);
  int num_wrong = 0, num_of[2] = {0, 0};
  for (int y = 0; y < kSceneHeight; ++y) {
    for (int x = 0; x < kSceneWidth; ++x) {
      const size_t pixel = static_cast<size_t>(y) * kSceneWidth + x;
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

}  // namespace
}  // namespace graspbench
