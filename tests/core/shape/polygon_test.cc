#include "core/shape/polygon.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>
#include <numeric>

#include "core/base/random.h"
#include "core/base/units.h"

namespace graspbench {
namespace {

// A polygon in a tilted plane, and its corners in order.
struct Polygon {
  explicit Polygon(const std::vector<Eigen::Vector2d>& points) {
    const Eigen::Vector3d u = Eigen::Vector3d(1.0, 2.0, -0.5).normalized();
    const Eigen::Vector3d v = normal.cross(u);
    for (const Eigen::Vector2d& p : points) mesh.vertices.push_back(p.x() * u + p.y() * v);
    corners.resize(points.size());
    std::iota(corners.begin(), corners.end(), 0);
  }
  Eigen::Vector3d normal =
      Eigen::Vector3d(1.0, 2.0, -0.5).cross(Eigen::Vector3d(0.3, 0.1, 0.9)).normalized();
  TriMesh mesh;
  std::vector<int> corners;
};

double CalcArea(const std::vector<Eigen::Vector2d>& points) {  // the shoelace formula
  double twice = 0.0;
  for (size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector2d &a = points[i], &b = points[(i + 1) % points.size()];
    twice += a.x() * b.y() - a.y() * b.x();
  }
  return 0.5 * twice;
}

// Every triangle turns like the polygon and together they have its area: they cover it once.
void ExpectCovered(const std::vector<Eigen::Vector2d>& points) {
  Polygon polygon(points);
  int64_t work = 1'000'000'000;
  ASSERT_TRUE(AppendPolygon(polygon.corners, polygon.mesh, work));
  ASSERT_EQ(polygon.mesh.triangles.size(), points.size() - 2);
  double area = 0.0;
  for (const Eigen::Vector3i& t : polygon.mesh.triangles) {
    const auto& v = polygon.mesh.vertices;
    const double part = 0.5 * (v[t[1]] - v[t[0]]).cross(v[t[2]] - v[t[0]]).dot(polygon.normal);
    EXPECT_GE(part, -1e-12);
    area += part;
  }
  EXPECT_NEAR(area, CalcArea(points), 1e-9 * std::abs(area));
}

TEST(PolygonTest, TrianglesCoverItOnce) {
  ExpectCovered({{0, 0}, {1, 0}, {1, 1}, {0, 1}});
  // An arrow whose fan about the first corner would leave it.
  ExpectCovered({{0, 0}, {2, 1}, {0, 2}, {1, 1}});
  ExpectCovered({{2, 1}, {0, 2}, {1, 1}, {0, 0}});
  // An L, a comb, a corner in the middle of an edge, a square with a hole joined by a bridge.
  ExpectCovered({{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 3}, {0, 3}});
  ExpectCovered({{0, 0}, {5, 0}, {5, 3}, {4, 1}, {3, 3}, {2, 1}, {1, 3}, {0, 1}});
  ExpectCovered({{0, 0}, {1, 0}, {2, 0}, {2, 2}, {1, 1}, {0, 2}});
  ExpectCovered({{0, 0}, {4, 0}, {4, 4}, {0, 4}, {0, 0}, {1, 1}, {1, 3}, {3, 3}, {3, 1}, {1, 1}});
}

TEST(PolygonTest, RandomStarsAreCovered) {
  RandomStream random("polygon", "stars");
  for (int trial = 0; trial < 200; ++trial) {
    const int count = 4 + random.NextIndex(60);
    std::vector<Eigen::Vector2d> points;
    for (int i = 0; i < count; ++i) {
      const double angle = 2.0 * kPi * i / count, radius = random.NextUniform(0.2, 1.0);
      points.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
    }
    ExpectCovered(points);
  }
}

TEST(PolygonTest, AFanWhereItIsRightWhateverTheSize) {
  std::vector<Eigen::Vector2d> circle;
  for (int i = 0; i < 100'000; ++i) {
    circle.emplace_back(std::cos(2.0 * kPi * i / 100'000), std::sin(2.0 * kPi * i / 100'000));
  }
  Polygon convex(circle);
  int64_t work = 0;
  EXPECT_TRUE(AppendPolygon(convex.corners, convex.mesh, work));
  EXPECT_EQ(convex.mesh.triangles[0], Eigen::Vector3i(0, 1, 2));

  circle[25'000] *= 0.5;  // not to be seen from the first corner
  Polygon dented(circle);
  work = 1'000'000;
  EXPECT_FALSE(AppendPolygon(dented.corners, dented.mesh, work));
  EXPECT_TRUE(dented.mesh.triangles.empty());
  EXPECT_EQ(work, 1'000'000);
}

TEST(PolygonTest, CrossedAndFlatOnesCloseWhatTheyClose) {
  RandomStream random("polygon", "crossed");
  for (int trial = 0; trial < 100; ++trial) {
    std::vector<Eigen::Vector2d> points;
    for (int i = 0; i < 12; ++i)
      points.emplace_back(random.NextUnit(), trial % 5 ? random.NextUnit() : 0.0);
    Polygon polygon(points);
    int64_t work = 1'000'000;
    ASSERT_TRUE(AppendPolygon(polygon.corners, polygon.mesh, work));
    // As a chain of directed edges the triangles leave exactly the polygon's rim.
    std::vector<std::vector<int>> net(12, std::vector<int>(12, 0));
    for (const Eigen::Vector3i& t : polygon.mesh.triangles) {
      for (int k = 0; k < 3; ++k) {
        ++net[t[k]][t[(k + 1) % 3]];
        --net[t[(k + 1) % 3]][t[k]];
      }
    }
    for (int i = 0; i < 12; ++i) {
      for (int j = 0; j < 12; ++j) {
        EXPECT_EQ(net[i][j], (j == (i + 1) % 12) - (i == (j + 1) % 12));
      }
    }
  }
}

}  // namespace
}  // namespace graspbench
