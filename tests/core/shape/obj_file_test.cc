#include "core/shape/obj_file.h"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace graspbench
