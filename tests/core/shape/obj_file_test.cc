#include "core/shape/obj_file.h"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "core/base/random.h"
#include "core/base/units.h"
#include "core/shape/primitives.h"

namespace graspbench {
namespace {

TEST(ObjFileTest, ReadsFansOfPolygonsAndSkipsTheRest) {
  Diagnostics problems;
  const TriMesh mesh = ParseObj(
      "# a square and a triangle\nmtllib x.mtl\nv 0 0 0\nv 1 0 0\r\nv 1 1 0 1.0\nvt 0 0\n"
      "v\t0 1 0\nusemtl red\nf 1/1/1 2//2 3/3 4\nf -1 -3 -2\n",
      "a.obj", problems);
  EXPECT_EQ(problems.Format(), "");
  ASSERT_EQ(mesh.num_vertices(), 4);
  EXPECT_EQ(mesh.vertices[2], Eigen::Vector3d(1, 1, 0));
  ASSERT_EQ(mesh.num_triangles(), 3);
  EXPECT_EQ(mesh.triangles[0], Eigen::Vector3i(0, 1, 2));
  EXPECT_EQ(mesh.triangles[1], Eigen::Vector3i(0, 2, 3));
  EXPECT_EQ(mesh.triangles[2], Eigen::Vector3i(3, 1, 2));
}

TEST(ObjFileTest, WhatIsWrittenIsReadBackToTheMicrometre) {
  const TriMesh sphere = MakeSphere(0.0123456789);
  Diagnostics problems;
  const TriMesh back = ParseObj(FormatObj(sphere), "s.obj", problems);
  EXPECT_EQ(problems.Format(), "");
  EXPECT_EQ(back.triangles, sphere.triangles);
  for (int i = 0; i < sphere.num_vertices(); ++i) {
    EXPECT_LT((back.vertices[i] - sphere.vertices[i]).cwiseAbs().maxCoeff(), 0.6e-6);
  }
  EXPECT_EQ(FormatObj(back), FormatObj(sphere));
  EXPECT_EQ(FormatObj(sphere).find("-0.000000"), std::string::npos);
}

TEST(ObjFileTest, TellsWhatIsWrongWithItsLine) {
  const auto problems_of = [](const std::string& text) {
    Diagnostics problems;
    EXPECT_EQ(ParseObj(text, "a.obj", problems).num_triangles(), 0);
    return problems.Format();
  };
  const std::string v = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  EXPECT_EQ(problems_of(v + "v 1 2\nf 1 2 3\n"),
            "a.obj:4: error: expected three finite numbers after v");
  EXPECT_EQ(problems_of(v + "v 1 2 nan\n"),
            "a.obj:4: error: expected three finite numbers after v");
  for (const char* face : {"f 1 2", "f 1 2 4", "f 0 1 2", "f 1 2 -4", "f 1 2 3x", "f"}) {
    EXPECT_EQ(problems_of(v + face + "\n"),
              "a.obj:4: error: expected three or more numbers of vertices above after f")
        << face;
  }
  EXPECT_EQ(problems_of(v), "a.obj: error: the mesh has no triangle");
  EXPECT_EQ(problems_of(""), "a.obj: error: the mesh has no triangle");
}

const Eigen::Vector3d kNormal =
    Eigen::Vector3d(1.0, 2.0, -0.5).cross(Eigen::Vector3d(0.3, 0.1, 0.9)).normalized();

/** A polygon in a tilted plane, as a file has it. */
TriMesh ParsePolygon(const std::vector<Eigen::Vector2d>& points, Diagnostics& problems) {
  const Eigen::Vector3d u = Eigen::Vector3d(1.0, 2.0, -0.5).normalized(), v = kNormal.cross(u);
  std::string text, face = "f";
  for (size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3d p = points[i].x() * u + points[i].y() * v;
    text += fmt::format("v {:.17g} {:.17g} {:.17g}\n", p.x(), p.y(), p.z());
    face += " " + std::to_string(i + 1);
  }
  return ParseObj(text + face + "\n", "p.obj", problems);
}

double CalcPolygonArea(const std::vector<Eigen::Vector2d>& points) {  // the shoelace formula
  double twice = 0.0;
  for (size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector2d &a = points[i], &b = points[(i + 1) % points.size()];
    twice += a.x() * b.y() - a.y() * b.x();
  }
  return 0.5 * twice;
}

// Every triangle turns like the polygon and together they have its area: they cover it once.
void ExpectCovered(const std::vector<Eigen::Vector2d>& points) {
  Diagnostics problems;
  const TriMesh mesh = ParsePolygon(points, problems);
  ASSERT_EQ(mesh.triangles.size(), points.size() - 2) << problems.Format();
  double area = 0.0;
  for (const Eigen::Vector3i& t : mesh.triangles) {
    const auto& v = mesh.vertices;
    const double part = 0.5 * (v[t[1]] - v[t[0]]).cross(v[t[2]] - v[t[0]]).dot(kNormal);
    EXPECT_GE(part, -1e-12);
    area += part;
  }
  EXPECT_NEAR(area, CalcPolygonArea(points), 1e-9 * std::abs(area));
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

TEST(PolygonTest, CrossedAndFlatOnesCloseWhatTheyClose) {
  RandomStream random("polygon", "crossed");
  for (int trial = 0; trial < 100; ++trial) {
    std::vector<Eigen::Vector2d> points;
    for (int i = 0; i < 12; ++i)
      points.emplace_back(random.NextUnit(), trial % 5 ? random.NextUnit() : 0.0);
    Diagnostics problems;
    const TriMesh mesh = ParsePolygon(points, problems);
    // As a chain of directed edges the triangles leave exactly the polygon's rim.
    std::vector<std::vector<int>> net(12, std::vector<int>(12, 0));
    for (const Eigen::Vector3i& t : mesh.triangles) {
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
