#include "core/shape/line_crossings.h"

#include <gtest/gtest.h>

#include "core/base/random.h"
#include "core/shape/primitives.h"
#include "core/shape/repair/mesh_topology.h"

namespace graspbench {
namespace {

int CalcWindingByLine(const LineCrossings& lines, int axis, const Eigen::Vector3d& p) {
  std::vector<LineCrossings::Crossing> crossings;
  lines.Find(p[(axis + 1) % 3], p[(axis + 2) % 3], crossings);
  int winding = 0, total = 0;
  for (const LineCrossings::Crossing& crossing : crossings) {
    if (crossing.at < p[axis]) winding += crossing.winding;
    total += crossing.winding;
  }
  EXPECT_EQ(total, 0) << "what goes in comes out";
  return winding;
}

// The sum of solid angles knows nothing of lines.
TEST(LineCrossingsTest, WindsAsTheSolidAngleDoes) {
  TriMesh mesh = MakeSphere(0.02, 24);
  const int first = mesh.num_vertices();
  const TriMesh box = MakeRoundedBox({0.03, 0.02, 0.05}, 0.0);
  for (const Eigen::Vector3d& p : box.vertices) {
    mesh.vertices.push_back(p + Eigen::Vector3d(0.011, 0.007, 0.003));
  }
  for (const Eigen::Vector3i& t : box.triangles) {
    mesh.triangles.push_back(t + Eigen::Vector3i::Constant(first));
  }
  RandomStream random("lines", "points");
  std::vector<int> seen(3, 0);
  for (int axis = 0; axis < 3; ++axis) {
    const LineCrossings lines(mesh, axis);
    for (int i = 0; i < 500; ++i) {
      const Eigen::Vector3d p(random.NextUniform(-0.03, 0.03), random.NextUniform(-0.03, 0.03),
                              random.NextUniform(-0.03, 0.03));
      const int expected = CalcWinding(mesh, p);
      ASSERT_EQ(CalcWindingByLine(lines, axis, p), expected) << p.transpose();
      ++seen[expected];
    }
  }
  for (const int count : seen) EXPECT_GT(count, 10);
}

// Through the middle of a box's face, where two triangles meet along the diagonal, and along its
// walls.
TEST(LineCrossingsTest, LinesThroughEdgesCountOnce) {
  TriMesh box;
  for (int i = 0; i < 8; ++i) box.vertices.emplace_back(i & 1, (i >> 1) & 1, i >> 2);
  box.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                   {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  const LineCrossings lines(box, 2);
  for (const double x : {0.25, 0.5, 0.75}) {
    EXPECT_EQ(CalcWindingByLine(lines, 2, {x, x, 0.5}), 1);
    EXPECT_EQ(CalcWindingByLine(lines, 2, {x, 1.0 - x, 0.5}), 1);
    EXPECT_EQ(CalcWindingByLine(lines, 2, {x, x, -0.5}), 0);
    EXPECT_EQ(CalcWindingByLine(lines, 2, {x, x, 1.5}), 0);
  }
}

}  // namespace
}  // namespace graspbench
