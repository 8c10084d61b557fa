#include "core/hand/import/shapes/point_grid.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace graspbench {
namespace {

using Eigen::Vector3d;

std::vector<Vector3d> ListPoints(int count, const Vector3d& size) {
  std::vector<Vector3d> points;
  double u = 0.0, v = 0.0, w = 0.0;
  for (int i = 0; i < count; ++i) {
    u = std::fmod(u + 0.8191725134, 1.0);
    v = std::fmod(v + 0.6710436067, 1.0);
    w = std::fmod(w + 0.5497004779, 1.0);
    points.push_back(Vector3d(u, v, w).cwiseProduct(size));
  }
  return points;
}

TEST(PointGridTest, VisitsEachPointWithinReachOnce) {
  const std::vector<Vector3d> points = ListPoints(3000, {0.3, 0.12, 0.01});
  const PointGrid grid(points);
  int num_visited = 0;
  for (const Vector3d& p : ListPoints(60, {0.36, 0.18, 0.03})) {
    for (const double reach : {0.001, 0.01, 0.05}) {
      std::multiset<size_t> visited;
      grid.Visit(p, reach, [&](size_t k) { visited.insert(k); });
      num_visited += static_cast<int>(visited.size());
      for (size_t k = 0; k < points.size(); ++k) {
        if ((points[k] - p).norm() <= reach) {
          EXPECT_EQ(visited.count(k), 1u) << p.transpose();
        }
        EXPECT_LE(visited.count(k), 1u);
      }
    }
  }
  EXPECT_LT(num_visited, 60 * 3 * 3000 / 10) << "most are passed over";
}

TEST(PointGridTest, HoldsNoPointOrOne) {
  int num_visited = 0;
  const auto count = [&](size_t) { ++num_visited; };
  PointGrid({}).Visit(Vector3d::Zero(), 1.0, count);
  EXPECT_EQ(num_visited, 0);
  const PointGrid one({Vector3d(0.1, 0.2, 0.3)});
  one.Visit(Vector3d(0.1, 0.2, 0.3), 0.0, count);
  EXPECT_EQ(num_visited, 1);
  one.Visit(Vector3d(0.1, 0.2, 0.4), 0.05, count);
  EXPECT_EQ(num_visited, 1);
}

}  // namespace
}  // namespace graspbench
