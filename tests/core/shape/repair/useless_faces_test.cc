#include "core/shape/repair/useless_faces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

#include "core/shape/mass_properties.h"
#include "core/shape/primitives.h"
#include "core/shape/repair/mesh_check.h"
#include "core/shape/repair/weld_vertices.h"
#include "tests/core/shape/join_meshes.h"

namespace graspbench {
namespace {

TriMesh MakeBox() { return MakeRoundedBox({0.04, 0.03, 0.02}, 0.0); }

Eigen::Vector3i Turn(const Eigen::Vector3i& t) { return {t[1], t[0], t[2]}; }

// The four sides of a box without the end at x = 0 or x = 1 of its length.
TriMesh MakeBoxWithoutEnd(double end) {
  TriMesh box = MakeBox();
  const double x = (end - 0.5) * 0.04;
  box.triangles.erase(std::remove_if(box.triangles.begin(), box.triangles.end(),
                                     [&](const Eigen::Vector3i& t) {
                                       return std::all_of(t.begin(), t.end(), [&](int i) {
                                         return std::abs(box.vertices[i].x() - x) < 1e-9;
                                       });
                                     }),
                      box.triangles.end());
  return box;
}

TEST(UselessFacesTest, FacesThatFaceOppositeWaysCancel) {
  TriMesh mesh = MakeBox();
  const std::vector<Eigen::Vector3i> before = mesh.triangles;
  EXPECT_EQ(DropDoubledFaces(mesh), 0);
  // Twice outwards and once inwards is once outwards.
  mesh.triangles.push_back(before[3]);
  mesh.triangles.push_back(Turn(before[3]));
  EXPECT_EQ(DropDoubledFaces(mesh), 2);
  EXPECT_EQ(mesh.triangles, before);
}

TEST(UselessFacesTest, CopiesGoButForBodiesThatShareFaces) {
  TriMesh copied = MakeBox();
  copied.triangles.push_back(copied.triangles[3]);
  EXPECT_EQ(DropDoubledFaces(copied), 1);
  EXPECT_EQ(copied.triangles, MakeBox().triangles);

  // Two boxes half in each other: the sides of both lie on each other, and each box needs its own.
  const double width = 0.02;
  const TriMesh box = MakeRoundedBox({width, width, width}, 0.0);
  const TriMesh row = JoinMeshes(JoinMeshes(box, box, {width, 0.0, 0.0}), box, {2 * width, 0, 0});
  const TriMesh both =
      WeldVertices(JoinMeshes(row, JoinMeshes(box, box, {width, 0, 0}), {width, 0, 0}), 1e-9);
  TriMesh cancelled = both;
  DropDoubledFaces(cancelled);
  const MeshReport report = CheckMesh(cancelled);
  EXPECT_EQ(FormatProblems(report), "");
  EXPECT_NEAR(report.volume, 3.0 * width * width * width, 1e-4 * report.volume);
}

TEST(UselessFacesTest, AWallAcrossTheInsideGoes) {
  const TriMesh left = MakeBoxWithoutEnd(1.0), right = MakeBoxWithoutEnd(0.0);
  TriMesh wall = MakeBox();
  wall.triangles.erase(std::remove_if(wall.triangles.begin(), wall.triangles.end(),
                                      [&](const Eigen::Vector3i& t) {
                                        return std::any_of(t.begin(), t.end(), [&](int i) {
                                          return wall.vertices[i].x() < 0.019;
                                        });
                                      }),
                       wall.triangles.end());
  ASSERT_GT(wall.num_triangles(), 0);
  for (const bool is_turned : {false, true}) {
    TriMesh part = wall;
    if (is_turned) {
      for (Eigen::Vector3i& t : part.triangles) t = Turn(t);
    }
    TriMesh mesh = WeldVertices(JoinMeshes(JoinMeshes(left, right, {0.04, 0.0, 0.0}), part), 1e-9);
    EXPECT_FALSE(CheckMesh(mesh).problems.empty());
    EXPECT_EQ(DropFins(mesh), wall.num_triangles());
    EXPECT_EQ(FormatProblems(CheckMesh(mesh)), "");
    EXPECT_NEAR(CalcVolume(mesh), 0.08 * 0.03 * 0.02, 1e-12);
  }
}

TEST(UselessFacesTest, ABodyIsNoFin) {
  TriMesh mesh = MakeBox();
  EXPECT_EQ(DropFins(mesh), 0);
  // Two boxes that touch along an edge.
  mesh = WeldVertices(JoinMeshes(mesh, MakeBox(), {0.04, 0.03, 0.0}), 1e-9);
  EXPECT_EQ(DropFins(mesh), 0);
  TriMesh none;
  EXPECT_EQ(DropLooseSheets(1.0, none), 0);
}

TEST(UselessFacesTest, LooseSheetsGoWhenTheyAreSmall) {
  TriMesh sheet;  // 1 cm^2 beside 52 cm^2
  sheet.vertices = {{0.05, 0, 0}, {0.06, 0, 0}, {0.06, 0.01, 0}, {0.05, 0.01, 0}};
  sheet.triangles = {{0, 1, 2}, {0, 2, 3}};
  TriMesh mesh = JoinMeshes(MakeBox(), sheet);
  EXPECT_EQ(DropLooseSheets(0.018, mesh), 0);
  EXPECT_EQ(DropLooseSheets(0.02, mesh), 2);
  EXPECT_EQ(mesh.triangles, MakeBox().triangles);
}

}  // namespace
}  // namespace graspbench
