#include "core/hand/link_solid.h"

#include <gtest/gtest.h>

#include "core/shape/primitives.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;

TEST(LinkSolidTest, OfABox) {
  const LinkSolid solid({MakeRoundedBox({0.04, 0.03, 0.02}, 0.0)});
  EXPECT_FALSE(solid.IsOutside(Vector3d::Zero()));
  EXPECT_TRUE(solid.IsOutside({0.022, 0, 0}));
  EXPECT_NEAR(solid.CalcOutside({0.025, 0.003, 0.001}), 0.005, 1e-12);
  EXPECT_NEAR(solid.CalcOutside({0.023, 0.019, 0.0}), 0.005, 1e-12);  // over an edge: 3, 4, 5
  EXPECT_EQ(solid.CalcOutside({0.015, 0.0, 0.0}), 0.0);
  for (const auto& point : solid.boundary()) {
    EXPECT_FALSE(point.is_membrane);
    EXPECT_GT(point.nhat.dot(point.p), 0.0);
  }
}

/** A box of 40 mm without its lid, of sheets. */
TriMesh MakeOpenBox(double hole) {
  TriMesh box = MakeRoundedBox({0.04, 0.04, 0.04}, 0.0), open;
  open.vertices = box.vertices;
  for (const Eigen::Vector3i& t : box.triangles) {
    const bool is_lid = box.vertices[t[0]].z() > 0.019 && box.vertices[t[1]].z() > 0.019 &&
                        box.vertices[t[2]].z() > 0.019;
    if (!is_lid) open.triangles.push_back(t);
  }
  const int first = open.num_vertices();  // a lid with a square hole
  for (const double half : {0.02, 0.5 * hole}) {
    for (const auto& [x, y] : {std::pair(-1.0, -1.0), {1.0, -1.0}, {1.0, 1.0}, {-1.0, 1.0}}) {
      open.vertices.emplace_back(half * x, half * y, 0.02);
    }
  }
  for (int k = 0; k < 4; ++k) {
    const int next = (k + 1) % 4;
    open.triangles.emplace_back(first + k, first + next, first + 4 + next);
    open.triangles.emplace_back(first + k, first + 4 + next, first + 4 + k);
  }
  return open;
}

// The closing ball of 6 mm does not pass a hole of 4 mm; a membrane spans it. Through one of 20 mm
// it does, and the lines across the box still wind around its inside.
TEST(LinkSolidTest, AHoleIsSpanned) {
  for (const double hole : {0.004, 0.02}) {
    const LinkSolid solid({MakeOpenBox(hole)});
    EXPECT_FALSE(solid.IsOutside(Vector3d::Zero())) << hole;
    EXPECT_TRUE(solid.IsOutside({0, 0, 0.022})) << hole;
    EXPECT_NEAR(solid.CalcOutside({0, 0, 0.025}), 0.005, 0.001) << hole;
  }
}

TEST(LinkSolidTest, ASheetHasTwoSides) {
  TriMesh sheet;
  sheet.vertices = {{-0.02, -0.02, 0}, {0.02, -0.02, 0}, {0.02, 0.02, 0}, {-0.02, 0.02, 0}};
  sheet.triangles = {{0, 1, 2}, {0, 2, 3}};
  const LinkSolid solid({sheet});
  EXPECT_NEAR(solid.CalcOutside({0, 0, 0.004}), 0.004, 1e-12);
  EXPECT_NEAR(solid.CalcOutside({0, 0, -0.004}), 0.004, 1e-12);
}

}  // namespace
}  // namespace graspbench
