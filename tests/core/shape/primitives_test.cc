#include "core/shape/primitives.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "core/base/units.h"
#include "core/shape/mass_properties.h"
#include "core/shape/repair/mesh_topology.h"

namespace graspbench {
namespace {

// Every directed edge once and its reverse once: closed, manifold, one orientation.
bool IsClosed(const TriMesh& mesh) {
  std::map<std::pair<int, int>, int> uses;
  for (const Eigen::Vector3i& t : mesh.triangles) {
    for (int k = 0; k < 3; ++k) ++uses[{t[k], t[(k + 1) % 3]}];
  }
  return std::all_of(uses.begin(), uses.end(), [&](const auto& use) {
    const auto reverse = uses.find({use.first.second, use.first.first});
    return use.second == 1 && reverse != uses.end() && reverse->second == 1;
  });
}

Eigen::Vector3d CalcExtent(const TriMesh& mesh) {
  Eigen::Vector3d low = mesh.vertices.front(), high = low;
  for (const Eigen::Vector3d& p : mesh.vertices) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  return high - low;
}

TEST(PrimitivesTest, SphereIsClosedAndItsVerticesLieOnIt) {
  const TriMesh sphere = MakeSphere(0.02, 24);
  EXPECT_TRUE(IsClosed(sphere));
  for (const Eigen::Vector3d& p : sphere.vertices) EXPECT_NEAR(p.norm(), 0.02, 1e-15);
  EXPECT_NEAR(CalcVolume(sphere), 4.0 / 3.0 * kPi * 8e-6, 0.03 * 3.4e-5);
}

TEST(PrimitivesTest, TaperedCapsuleIsTheHullOfItsBalls) {
  const Eigen::Vector3d a(0.0, 0.0, 0.0), b(0.03, 0.01, -0.02);
  const TriMesh capsule = MakeTaperedCapsule(a, 0.01, b, 0.006, 96);
  EXPECT_TRUE(IsClosed(capsule));
  // Support in every direction: max over the two balls.
  for (int i = 0; i < 50; ++i) {
    const Eigen::Vector3d n =
        Eigen::Vector3d(std::sin(1.0 + i), std::cos(2.3 * i), std::sin(0.7 * i)).normalized();
    double support = -1.0;
    for (const Eigen::Vector3d& p : capsule.vertices) support = std::max(support, n.dot(p));
    EXPECT_NEAR(support, std::max(n.dot(a) + 0.01, n.dot(b) + 0.006), 2e-5);
  }
}

TEST(PrimitivesTest, ABallInsideTheOtherLeavesTheLargerOne) {
  const TriMesh capsule = MakeTaperedCapsule({0, 0, 0}, 0.02, {0, 0, 0.005}, 0.01);
  EXPECT_TRUE(IsClosed(capsule));
  EXPECT_LT((CalcExtent(capsule) - Eigen::Vector3d::Constant(0.04)).norm(), 1e-12);
}

TEST(PrimitivesTest, RoundedBoxHasItsSizeAndSteinersVolume) {
  const Eigen::Vector3d size(0.05, 0.04, 0.03);
  const TriMesh plain = MakeRoundedBox(size, 0.0);
  EXPECT_TRUE(IsClosed(plain));
  EXPECT_NEAR(CalcVolume(plain), size.prod(), 1e-18);

  const double r = 0.004;
  const TriMesh rounded = MakeRoundedBox(size, r, 32);
  EXPECT_TRUE(IsClosed(rounded));
  EXPECT_LT((CalcExtent(rounded) - size).norm(), 1e-15);
  // V = core + faces r + edges pi r^2 / 4 + ball
  const Eigen::Vector3d c = size - Eigen::Vector3d::Constant(2.0 * r);
  const double faces = 2.0 * (c.x() * c.y() + c.y() * c.z() + c.z() * c.x());
  const double expected =
      c.prod() + faces * r + c.sum() * kPi * r * r + 4.0 / 3.0 * kPi * r * r * r;
  EXPECT_NEAR(CalcVolume(rounded), expected, 1e-3 * expected);
}

TEST(PrimitivesTest, RevolutionOfARectangleIsACylinder) {
  const TriMesh cylinder = MakeRevolution({{0, -0.05}, {0.03, -0.05}, {0.03, 0.05}, {0, 0.05}}, 64);
  EXPECT_TRUE(IsClosed(cylinder));
  const double polygon_area = 0.5 * 64 * std::sin(2.0 * kPi / 64) * 0.03 * 0.03;
  EXPECT_NEAR(CalcVolume(cylinder), polygon_area * 0.1, 1e-15);
}

TEST(PrimitivesTest, JoinedRingsMakeATorus) {
  std::vector<Ring> rings;
  const double major = 0.03, minor = 0.01;
  for (int i = 0; i < 48; ++i) {
    const double turn = 2.0 * kPi * i / 48;
    Ring ring;
    for (int j = 0; j < 24; ++j) {
      const double angle = 2.0 * kPi * j / 24;
      const double r = major + minor * std::cos(angle);
      ring.emplace_back(r * std::cos(turn), r * std::sin(turn), -minor * std::sin(angle));
    }
    rings.push_back(ring);
  }
  const TriMesh torus = MakeLoft(rings, LoftEnds::kJoined);
  EXPECT_TRUE(IsClosed(torus));
  EXPECT_EQ(torus.num_vertices(), 48 * 24);
  EXPECT_NEAR(CalcVolume(torus), 2.0 * kPi * kPi * major * minor * minor, 0.02 * 6e-5);
}

TEST(WeldVerticesTest, JoinsNearVerticesAcrossCellsAndDropsWhatCollapses) {
  TriMesh mesh;
  // 1 lies within the tolerance of 0, on the other side of a cell border.
  mesh.vertices = {{1e-9, 0, 0}, {-1e-9, 0, 0}, {1, 0, 0}, {0, 1, 0}, {7, 7, 7}};
  mesh.triangles = {{0, 2, 3}, {1, 3, 2}, {0, 1, 2}};
  const TriMesh welded = WeldVertices(mesh, 1e-6);
  EXPECT_EQ(welded.num_vertices(), 3);
  ASSERT_EQ(welded.num_triangles(), 2);
  EXPECT_EQ(welded.triangles[0], Eigen::Vector3i(0, 1, 2));
  EXPECT_EQ(welded.triangles[1], Eigen::Vector3i(0, 2, 1));
}

}  // namespace
}  // namespace graspbench
