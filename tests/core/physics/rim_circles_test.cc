#include "core/physics/rim_circles.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/shape/primitives.h"

namespace graspbench {
namespace {

std::vector<RimCircle> FindAll(const TriMesh& mesh) {
  return FindRimCircles(mesh, std::vector<bool>(mesh.vertices.size(), true));
}

TriMesh MakeDrum(int num_segments) {
  return MakeRevolution({{0.0, -0.02}, {0.03, -0.02}, {0.03, 0.02}, {0.0, 0.02}}, num_segments);
}

TEST(RimCircles, ACylinderHasTwoThroughItsVertices) {
  for (const int segments : {19, 24, 64, 384}) {
    const std::vector<RimCircle> circles = FindAll(MakeDrum(segments));
    ASSERT_EQ(circles.size(), 2u) << segments;
    for (const RimCircle& circle : circles) {
      EXPECT_NEAR(circle.radius, 0.03, 1e-9);
      EXPECT_NEAR(std::abs(circle.axis_O.z()), 1.0, 1e-9);
      EXPECT_NEAR(std::abs(circle.p_OCentre.z()), 0.02, 1e-9);
      EXPECT_LT(circle.p_OCentre.head<2>().norm(), 1e-9);
      EXPECT_EQ(circle.vertices.size(), static_cast<size_t>(segments));
    }
  }
}

TEST(RimCircles, APrismOfFewSidesStaysOne) {
  for (const int segments : {4, 6, 12, 16, 18}) {
    EXPECT_TRUE(FindAll(MakeDrum(segments)).empty()) << segments;
  }
}

TEST(RimCircles, ABoxHasNone) {
  EXPECT_TRUE(FindAll(MakeRoundedBox(Eigen::Vector3d(0.06, 0.04, 0.02), 0.004)).empty());
}

TEST(RimCircles, HalfATurnIsNone) {
  // The rims of half a cylinder.
  std::vector<Ring> rings(2);
  for (int i = 0; i <= 32; ++i) {
    const double angle = 3.14159265358979 * i / 32;
    rings[0].emplace_back(0.03 * std::cos(angle), 0.03 * std::sin(angle), -0.02);
    rings[1].emplace_back(0.03 * std::cos(angle), 0.03 * std::sin(angle), 0.02);
  }
  EXPECT_TRUE(FindAll(MakeLoft(rings)).empty());
}

}  // namespace
}  // namespace graspbench
