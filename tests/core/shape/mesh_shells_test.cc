#include "core/shape/mesh_shells.h"

#include <gtest/gtest.h>

#include "core/shape/primitives.h"

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

}  // namespace
}  // namespace graspbench
