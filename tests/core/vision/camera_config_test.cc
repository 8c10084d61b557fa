#include "core/vision/camera_config.h"

#include <gtest/gtest.h>

#include <cmath>

namespace graspbench {
namespace {

TEST(CameraConfigTest, AColourIsReadAsOnAWebPage) {
  const auto colour = ParseColour("#ff8000");
  ASSERT_TRUE(colour);
  EXPECT_FLOAT_EQ(colour->x(), 1.0f);
  EXPECT_FLOAT_EQ(colour->y(), 128.0f / 255.0f);
  EXPECT_FLOAT_EQ(colour->z(), 0.0f);
  EXPECT_TRUE(ParseColour(CameraConfig().table_colour));
  for (const char* wrong : {"", "#", "ff8000", "#ff800", "#ff80000", "#ff80g0", "#-f8000", "red"}) {
    EXPECT_FALSE(ParseColour(wrong)) << wrong;
  }
}

using Eigen::Vector2d;
using Eigen::Vector3d;

// By hand: x = 0.3, y = -0.2, r^2 = 0.13.
TEST(LensTest, DistortsAsTheEquationsSay) {
  Lens lens;
  lens.focal_x = 500.0;
  lens.focal_y = 600.0;
  lens.centre_x = 310.0;
  lens.centre_y = 250.0;
  lens.k1 = -0.2;
  lens.k2 = 0.1;
  lens.p1 = 0.01;
  lens.p2 = -0.02;
  const double s = 1.0 - 0.2 * 0.13 + 0.1 * 0.0169;
  const double x = 0.3 * s + 2.0 * 0.01 * -0.06 - 0.02 * (0.13 + 0.18);
  const double y = -0.2 * s + 0.01 * (0.13 + 0.08) - 2.0 * 0.02 * -0.06;
  const Vector2d pixel = Project(lens, Vector3d(0.6, -0.4, 2.0));
  EXPECT_NEAR(pixel.x(), 310.0 + 500.0 * x, 1e-9);
  EXPECT_NEAR(pixel.y(), 250.0 + 600.0 * y, 1e-9);
}

TEST(LensTest, TheRayThroughAPixelIsShownThere) {
  Lens lens;
  lens.k1 = -0.25;
  lens.k2 = 0.06;
  lens.p1 = 0.002;
  lens.p2 = -0.003;
  for (const double u : {0.0, 100.5, 320.0, 640.0}) {
    for (const double v : {0.0, 240.0, 333.0, 480.0}) {
      const Vector3d ray = CalcRay(lens, Vector2d(u, v));
      EXPECT_EQ(ray.z(), 1.0);
      EXPECT_LT((Project(lens, 3.0 * ray) - Vector2d(u, v)).norm(), 1e-8) << u << " " << v;
    }
  }
}

}  // namespace
}  // namespace graspbench
