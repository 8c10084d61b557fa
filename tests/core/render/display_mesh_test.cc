#include "core/render/display_mesh.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "core/shape/primitives.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;

TEST(DisplayMeshTest, CubeKeepsItsEdgesBelowTheCreaseAngle) {
  const TriMesh cube = MakeRoundedBox(Vector3d::Constant(2.0), 0.0);
  const DisplayMesh sharp = MakeDisplayMesh(cube, 0.7);
  EXPECT_EQ(sharp.vertices.size(), 24u + 2u);  // three at each corner; two caps
  for (const DisplayVertex& vertex : sharp.vertices) {
    EXPECT_NEAR(vertex.normal.cwiseAbs().maxCoeff(), 1.0f, 1e-6f);
    EXPECT_NEAR(vertex.normal.dot(vertex.position), 1.0f, 1e-6f);  // on its own face
  }
  const DisplayMesh round = MakeDisplayMesh(cube, M_PI);
  EXPECT_EQ(round.vertices.size(), 8u + 2u);
  for (const DisplayVertex& vertex : round.vertices) {
    EXPECT_TRUE(vertex.normal.isApprox(vertex.position.normalized(), 1e-6f));
  }
}

TEST(DisplayMeshTest, SphereHasRadialNormals) {
  const TriMesh sphere = MakeSphere(0.03, 64);
  const DisplayMesh display = MakeDisplayMesh(sphere, 0.7);
  EXPECT_EQ(static_cast<int>(display.vertices.size()), sphere.num_vertices());
  EXPECT_EQ(static_cast<int>(display.indices.size()), 3 * sphere.num_triangles());
  for (const DisplayVertex& vertex : display.vertices) {
    EXPECT_GT(vertex.normal.dot(vertex.position.normalized()), std::cos(0.02));
  }
}

TEST(DisplayMeshTest, ClosedMeansFacingOutwardsAllAround) {
  const TriMesh cube = MakeRoundedBox(Vector3d::Constant(2.0), 0.0);
  EXPECT_TRUE(MakeDisplayMesh(cube, 0.7).is_closed);
  TriMesh open = cube;
  open.triangles.pop_back();
  EXPECT_FALSE(MakeDisplayMesh(open, 0.7).is_closed);
  TriMesh inverted = cube;
  for (Eigen::Vector3i& triangle : inverted.triangles) std::swap(triangle[0], triangle[1]);
  EXPECT_FALSE(MakeDisplayMesh(inverted, 0.7).is_closed);
}

TEST(DisplayMeshTest, CoarseMeshKeepsTheShapeWithFewTriangles) {
  const double radius = 0.03;
  const TriMesh sphere = MakeSphere(radius, 128);
  for (const int wanted : {2000, 500, 100}) {
    const TriMesh coarse = MakeCoarseMesh(sphere, wanted);
    EXPECT_LE(coarse.num_triangles(), wanted);
    EXPECT_GT(coarse.num_triangles(), wanted / 4);
    double volume = 0.0;
    for (const Eigen::Vector3i& t : coarse.triangles) {
      volume += coarse.vertices[t[0]].cross(coarse.vertices[t[1]]).dot(coarse.vertices[t[2]]) / 6.0;
    }
    const double full = 4.0 / 3.0 * M_PI * std::pow(radius, 3);
    // A regular polyhedron of n faces with its corners on a sphere lacks some 8 / n of the volume.
    EXPECT_GT(volume, (1.0 - 4.0 * 8.0 / wanted) * full) << wanted;
    EXPECT_LT(volume, full) << wanted;
  }
  EXPECT_EQ(MakeCoarseMesh(sphere, sphere.num_triangles()).vertices, sphere.vertices);
  EXPECT_EQ(MakeCoarseMesh(sphere, 0).num_triangles(), 0);
}

}  // namespace
}  // namespace graspbench
