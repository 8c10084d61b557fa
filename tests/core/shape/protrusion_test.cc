#include "core/shape/protrusion.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/units.h"
#include "core/shape/primitives.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;

constexpr double kExact = 1e-7;  // [m]

/** Corners of a cube of 40 mm about the origin, twice, and points within. */
std::vector<Vector3d> MakeCube() {
  std::vector<Vector3d> points;
  for (int k = 0; k < 24; ++k) {
    const double half = k < 16 ? 0.02 : 0.01;
    points.emplace_back(k & 1 ? half : -half, k & 2 ? half : -half, k & 4 ? half : -half);
  }
  return points;
}

TEST(ProtrusionTest, OutOfACubeOverAFaceAnEdgeAndACorner) {
  const std::vector<Vector3d> cube = MakeCube();
  EXPECT_EQ(CalcProtrusion(cube, {}), 0.0);
  EXPECT_NEAR(CalcProtrusion(cube, {{{0.004, 0.0, 0.003}, 0.012}}), 0.0, kExact);
  // The centre within: r less the depth of the nearest face.
  EXPECT_NEAR(CalcProtrusion(cube, {{{0.004, 0.0, 0.015}, 0.012}}), 0.007, kExact);
  EXPECT_NEAR(CalcProtrusion(cube, {{{-0.019, 0.003, -0.002}, 0.012}}), 0.011, kExact);
  // Outside: r and the distance of the centre.
  EXPECT_NEAR(CalcProtrusion(cube, {{{0.023, 0.024, 0.001}, 0.002}}), 0.007, kExact);
  EXPECT_NEAR(CalcProtrusion(cube, {{{0.022, 0.023, -0.026}, 0.002}}), 0.009, kExact);
  // The largest of all balls, in any order.
  const Ball within{{0.0, 0.0, 0.0}, 0.01}, beyond{{0.0, 0.0, 0.02}, 0.01};
  EXPECT_NEAR(CalcProtrusion(cube, {within, beyond}), 0.01, kExact);
  EXPECT_NEAR(CalcProtrusion(cube, {beyond, within}), 0.01, kExact);
}

// Of a ball of radius R about the origin: |c| + r - R.
TEST(ProtrusionTest, OutOfASphere) {
  const std::vector<Vector3d> sphere = MakeSphere(0.03, 128).vertices;
  const double facets = 0.03 * (1.0 - std::cos(kPi / 128.0));
  for (const Vector3d& c : {Vector3d(0.01, 0.005, 0.003), Vector3d(0.002, -0.03, 0.02)}) {
    const double expected = c.norm() + 0.03 - 0.03;
    EXPECT_GT(CalcProtrusion(sphere, {{c, 0.03}}), expected - 0.01 * 0.03);
    EXPECT_LT(CalcProtrusion(sphere, {{c, 0.03}}), expected + 2.0 * facets + 5e-5);
  }
}

// Half a tube and the whole ball of its radius: out of the open side by the radius.
TEST(ProtrusionTest, OutOfTheOpenSideOfHalfATube) {
  std::vector<Vector3d> tube;
  for (int k = 0; k <= 90; ++k) {
    const double angle = kPi * k / 90.0;
    for (const double r : {0.04, 0.042}) {
      for (const double z : {-0.045, 0.045}) {
        tube.emplace_back(r * std::cos(angle), r * std::sin(angle), z);
      }
    }
  }
  EXPECT_NEAR(CalcProtrusion(tube, {{{0.0, 0.0, 0.001}, 0.042}}), 0.042, kExact);
  EXPECT_NEAR(CalcProtrusion(tube, {{{0.0, 0.0, 0.033}, 0.042}}), 0.042, kExact);
  // A ball in the hollow, 2 mm below the open side.
  EXPECT_NEAR(CalcProtrusion(tube, {{{0.0, 0.012, 0.0}, 0.01}}), 0.0, kExact);
}

// A plate of no thickness, one point, all points on a line: a ball sticks out by its own radius or
// more.
TEST(ProtrusionTest, OutOfWhatHasNoVolume) {
  const Ball ball{{0.0, 0.0, 0.004}, 0.002};
  EXPECT_NEAR(CalcProtrusion({Vector3d::Zero()}, {ball}), 0.006, kExact);
  EXPECT_NEAR(CalcProtrusion({{-1.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {0.5, 0.0, 0.0}}, {ball}), 0.006,
              kExact);
  EXPECT_NEAR(CalcProtrusion({{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}, {ball}), 0.006,
              kExact);
}

}  // namespace
}  // namespace graspbench
