#include "core/shape/triangle_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/base/random.h"
#include "core/shape/primitives.h"

namespace graspbench {
namespace {

using Feature = TriangleTree::Feature;

TEST(TriangleTreeTest, NamesTheSevenRegionsOfATriangle) {
  TriMesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.triangles = {{0, 1, 2}};
  const TriangleTree tree(mesh);
  const auto feature = [&](double x, double y) { return tree.FindNearest({x, y, 0.5}).feature; };
  EXPECT_EQ(feature(0.2, 0.2), Feature::kFace);
  EXPECT_EQ(feature(0.5, -1.0), Feature::kEdge01);
  EXPECT_EQ(feature(1.0, 1.0), Feature::kEdge12);
  EXPECT_EQ(feature(-1.0, 0.5), Feature::kEdge20);
  EXPECT_EQ(feature(-1.0, -1.0), Feature::kVertex0);
  EXPECT_EQ(feature(2.0, 0.0), Feature::kVertex1);
  EXPECT_EQ(feature(0.0, 2.0), Feature::kVertex2);
  EXPECT_NEAR(tree.FindNearest({1.0, 1.0, 0.0}).squared_distance, 0.5, 1e-15);
}

TEST(TriangleTreeTest, TheHintChangesNothing) {
  const TriMesh mesh = MakeTaperedCapsule({0, 0, 0}, 0.02, {0.05, 0.01, 0}, 0.01);
  const TriangleTree tree(mesh);
  RandomStream random("tree", "hints");
  for (int i = 0; i < 500; ++i) {
    const Eigen::Vector3d p =
        0.05 * Eigen::Vector3d(random.NextNormal(), random.NextNormal(), random.NextNormal());
    const double plain = tree.FindNearest(p).squared_distance;
    const double hinted =
        tree.FindNearest(p, random.NextIndex(mesh.num_triangles())).squared_distance;
    ASSERT_NEAR(plain, hinted, 1e-15);
  }
}

TEST(TriangleTreeTest, FindsAllTrianglesNearABox) {
  const TriMesh mesh = MakeSphere(0.03, 40);
  const TriangleTree tree(mesh);
  const Eigen::AlignedBox3d box(Eigen::Vector3d(0.01, 0.0, 0.0), Eigen::Vector3d(0.04, 0.01, 0.01));
  std::vector<int> found, expected;
  tree.FindNear(box, found);
  std::sort(found.begin(), found.end());
  for (int i = 0; i < mesh.num_triangles(); ++i) {
    Eigen::AlignedBox3d own;
    for (int k = 0; k < 3; ++k) own.extend(mesh.vertices[mesh.triangles[i][k]]);
    if (own.intersects(box)) expected.push_back(i);
  }
  EXPECT_FALSE(expected.empty());
  EXPECT_EQ(found, expected);
}

}  // namespace
}  // namespace graspbench
