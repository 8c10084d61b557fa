#include "core/physics/mesh_outline.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/base/units.h"
#include "core/shape/primitives.h"
#include "tests/core/physics/random_vector.h"

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

TEST(RimCircles, ABoxAndHalfATurnHaveNone) {
  EXPECT_TRUE(FindAll(MakeRoundedBox(Eigen::Vector3d(0.06, 0.04, 0.02), 0.004)).empty());
  // The rims of half a cylinder.
  std::vector<Ring> rings(2);
  for (int i = 0; i <= 32; ++i) {
    const double angle = kPi * i / 32;
    rings[0].emplace_back(0.03 * std::cos(angle), 0.03 * std::sin(angle), -0.02);
    rings[1].emplace_back(0.03 * std::cos(angle), 0.03 * std::sin(angle), 0.02);
  }
  EXPECT_TRUE(FindAll(MakeLoft(rings)).empty());
}

using Eigen::Vector3d;

/** Every vertex tried; the first of equals. */
size_t FindByTrial(const std::vector<Vector3d>& vertices, const Vector3d& direction) {
  size_t best = 0;
  for (size_t i = 0; i < vertices.size(); ++i) {
    if (direction.dot(vertices[i]) > direction.dot(vertices[best])) best = i;
  }
  return best;
}

// Many directions of a few whole numbers make ties on a round mesh and on a box; all of the others
// none. Strides do not matter.
TEST(OutermostVertices, AreThoseThatTryingEveryVertexGives) {
  std::vector<Vector3d> directions;
  for (int k = 0; k < 343; ++k) directions.emplace_back(k % 7 - 3, k / 7 % 7 - 3, k / 49 - 3);
  RandomStream random("outermost vertices", "test");
  for (int k = 0; k < 500; ++k) directions.push_back(MakeRandomVector(3, 1.0, random));
  std::vector<Vector3d> cloud;
  for (int k = 0; k < 1000; ++k) cloud.push_back(MakeRandomVector(3, 0.01, random));
  for (const std::vector<Vector3d>& vertices :
       {MakeSphere(0.03, 32).vertices, MakeRoundedBox(Vector3d(0.06, 0.04, 0.02), 0.0).vertices,
        cloud, std::vector<Vector3d>(100, Vector3d(0.01, 0.02, 0.03))}) {
    for (const size_t stride : {size_t{1}, size_t{89}, size_t{5000}}) {
      const std::vector<size_t> found = FindOutermostVertices(vertices, directions, stride);
      ASSERT_EQ(found.size(), directions.size());
      for (size_t k = 0; k < directions.size(); ++k) {
        ASSERT_EQ(found[k], FindByTrial(vertices, directions[k])) << "direction " << k;
      }
    }
  }
}

}  // namespace
}  // namespace graspbench
