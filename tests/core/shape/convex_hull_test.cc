#include "core/shape/convex_hull.h"

#include <gtest/gtest.h>

#include "core/shape/mass_properties.h"
#include "core/shape/primitives.h"
#include "core/shape/repair/mesh_check.h"

namespace graspbench {
namespace {

TEST(ConvexHullTest, OfABoxAndWhatIsWithinIsTheBox) {
  const TriMesh box = MakeRoundedBox({0.04, 0.03, 0.02}, 0.0);
  std::vector<Eigen::Vector3d> points = {Eigen::Vector3d::Zero()};
  points.insert(points.end(), box.vertices.begin(), box.vertices.end());
  points.insert(points.end(), {{0.01, 0.0, 0.01}, {0.02, 0.0, 0.0}, {0.0, -0.015, 0.0}});
  const TriMesh hull = MakeConvexHull(points);
  EXPECT_NEAR(CalcVolume(hull), 0.04 * 0.03 * 0.02, 1e-15);
  EXPECT_EQ(FormatProblems(CheckMesh(hull)), "");
}

TEST(ConvexHullTest, OfASphereHasAllItsPointsAndItsVolume) {
  const TriMesh sphere = MakeSphere(0.02, 24);
  const TriMesh hull = MakeConvexHull(sphere.vertices);
  EXPECT_EQ(hull.num_vertices(), sphere.num_vertices());
  EXPECT_NEAR(CalcVolume(hull), CalcVolume(sphere), 1e-9 * CalcVolume(sphere));
}

TEST(ConvexHullTest, OfAPlaneIsNothing) {
  EXPECT_TRUE(MakeConvexHull({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}).triangles.empty());
  EXPECT_TRUE(MakeConvexHull({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}}).triangles.empty());
  EXPECT_TRUE(MakeConvexHull({}).triangles.empty());
}

}  // namespace
}  // namespace graspbench
