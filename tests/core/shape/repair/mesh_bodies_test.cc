#include "core/shape/repair/mesh_bodies.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "core/shape/primitives.h"
#include "tests/core/shape/join_meshes.h"

namespace graspbench {
namespace {

constexpr double kSide = 0.01;

TriMesh MakeCube() { return MakeRoundedBox({kSide, kSide, kSide}, 0.0); }

Bodies FindBodiesOf(const TriMesh& mesh) { return FindBodies(mesh, FindShells(mesh), 1e-5); }

// Along x, y and the diagonals: face to face, edge to edge, corner to corner.
TEST(FindBodies, CubesAreOneBodyWhereTheyTouch) {
  for (const Eigen::Vector3d& way : {Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(0, 1, 0),
                                     Eigen::Vector3d(1, 1, 0), Eigen::Vector3d(1, 1, 1)}) {
    const TriMesh touching = JoinMeshes(MakeCube(), MakeCube(), kSide * way);
    const TriMesh near = JoinMeshes(MakeCube(), MakeCube(), (kSide + 5e-6) * way);
    const TriMesh apart = JoinMeshes(MakeCube(), MakeCube(), (kSide + 2e-5) * way);
    EXPECT_EQ(FindBodiesOf(touching).apart.count, 0) << way.transpose();
    EXPECT_EQ(FindBodiesOf(near).apart.count, 0) << way.transpose();
    EXPECT_EQ(FindBodiesOf(apart).apart.count, 1) << way.transpose();
    EXPECT_NEAR(FindBodiesOf(apart).apart.volume, std::pow(kSide, 3), 1e-15);
  }
}

TEST(FindBodies, CountsAllButTheLargestAndJoinsChains) {
  TriMesh mesh = MakeRoundedBox({0.05, 0.02, 0.02}, 0.0);
  for (int i = 0; i < 3; ++i) mesh = JoinMeshes(mesh, MakeCube(), {0.1 + i * kSide, 0.0, 0.0});
  mesh = JoinMeshes(mesh, MakeCube(), {-0.1, 0.0, 0.0});
  const Bodies bodies = FindBodiesOf(mesh);
  EXPECT_EQ(bodies.apart.count, 2);  // a chain of three cubes, and a single one
  EXPECT_NEAR(bodies.apart.volume, 4.0 * std::pow(kSide, 3), 1e-15);
  EXPECT_EQ(bodies.nested.count, 0);
}

TEST(FindBodies, TellsNestedBodiesFromCavities) {
  const TriMesh outer = MakeRoundedBox({0.05, 0.05, 0.05}, 0.0);
  TriMesh cavity = MakeRoundedBox({0.03, 0.03, 0.03}, 0.0);
  for (Eigen::Vector3i& t : cavity.triangles) std::swap(t[0], t[1]);
  const TriMesh hollow = JoinMeshes(outer, cavity);
  EXPECT_EQ(FindBodiesOf(hollow).apart.count + FindBodiesOf(hollow).nested.count, 0);
  EXPECT_EQ(FindBodiesOf(JoinMeshes(outer, MakeCube())).nested.count, 1);
  EXPECT_EQ(FindBodiesOf(JoinMeshes(hollow, MakeCube())).apart.count, 1);
  const TriMesh in_the_wall =
      JoinMeshes(hollow, MakeRoundedBox({0.002, 0.002, 0.002}, 0.0), {0.02, 0.0, 0.0});
  EXPECT_EQ(FindBodiesOf(in_the_wall).nested.count, 1);
}

}  // namespace
}  // namespace graspbench
