#include "core/shape/repair/mesh_shells.h"

#include <gtest/gtest.h>

#include "core/shape/mass_properties.h"
#include "core/shape/primitives.h"
#include "core/shape/repair/weld_vertices.h"
#include "tests/core/shape/join_meshes.h"

namespace graspbench {
namespace {

TEST(MeshShellsTest, PartsAreToldApart) {
  TriMesh mesh = MakeSphere(0.02, 16);
  const int first = mesh.num_vertices(), num_outer = mesh.num_triangles();
  const TriMesh inner = MakeSphere(0.01, 16);
  mesh.vertices.insert(mesh.vertices.end(), inner.vertices.begin(), inner.vertices.end());
  for (const Eigen::Vector3i& t : inner.triangles) {
    mesh.triangles.push_back(t + Eigen::Vector3i::Constant(first));
  }
  const Shells shells = FindShells(mesh);
  ASSERT_EQ(shells.count, 2);
  for (int i = 0; i < mesh.num_triangles(); ++i) {
    EXPECT_EQ(shells.of_triangle[i], i < num_outer ? 0 : 1);
  }
  const std::vector<TriMesh> parts = SplitShells(mesh, shells);
  EXPECT_EQ(parts[0].num_triangles(), num_outer);
  EXPECT_EQ(CalcWinding(parts[1], Eigen::Vector3d(0.001, 0.0, 0.0)), 1);
  EXPECT_EQ(CalcWinding(parts[1], Eigen::Vector3d(0.015, 0.0, 0.0)), 0);
  EXPECT_EQ(CalcWinding(mesh, Eigen::Vector3d(0.001, 0.0, 0.0)), 2);
  EXPECT_EQ(FindShells({}).count, 0);
}

// At an edge of four triangles: two bodies that touch there, or one that needs all four.
TEST(MeshShellsTest, BodiesThatTouchAtAnEdgeAreTwo) {
  const TriMesh box = MakeRoundedBox({0.04, 0.03, 0.02}, 0.0);
  const TriMesh touching = WeldVertices(JoinMeshes(box, box, {0.04, 0.03, 0.0}), 1e-9);
  EXPECT_LT(touching.num_vertices(), 2 * box.num_vertices());
  const Shells shells = FindShells(touching);
  ASSERT_EQ(shells.count, 2);
  for (const TriMesh& part : SplitShells(touching, shells)) {
    EXPECT_EQ(part.num_vertices(), box.num_vertices());
    EXPECT_NEAR(CalcVolume(part), 0.04 * 0.03 * 0.02, 1e-12);
  }
}

TEST(MeshShellsTest, SamplesLieOnTheSurfaceAndAreFew) {
  const TriMesh ball = MakeSphere(0.02, 64);
  const std::vector<Eigen::Vector3d> points = SampleSurface(ball);
  EXPECT_GE(points.size(), 10u);
  EXPECT_LE(points.size(), 20u);
  for (const Eigen::Vector3d& p : points) EXPECT_NEAR(p.norm(), 0.02, 1e-4);
}

}  // namespace
}  // namespace graspbench
