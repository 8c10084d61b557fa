#include "core/shape/repair/fill_holes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "core/shape/mass_properties.h"
#include "core/shape/primitives.h"
#include "core/shape/repair/mesh_check.h"
#include "core/shape/repair/mesh_repair.h"
#include "tests/core/shape/join_meshes.h"

namespace graspbench {
namespace {

TriMesh MakeBall() { return MakeSphere(0.02, 24); }

template <class Keep>
TriMesh TakeFaces(TriMesh mesh, const Keep& is_kept) {
  mesh.triangles.erase(
      std::remove_if(mesh.triangles.begin(), mesh.triangles.end(),
                     [&](const Eigen::Vector3i& t) {
                       return !is_kept(
                           (mesh.vertices[t[0]] + mesh.vertices[t[1]] + mesh.vertices[t[2]]) / 3.0);
                     }),
      mesh.triangles.end());
  return mesh;
}

// Holes at random, many of which meet in a vertex, so that their rim is no simple loop.
TEST(FillHolesTest, ManyHolesThatTouchAreClosed) {
  for (int seed = 1; seed <= 5; ++seed) {
    std::mt19937 random(seed);
    const TriMesh ball = MakeSphere(0.02, 40);
    TriMesh mesh = ball;
    const int num_before = mesh.num_triangles();
    for (int i = 0; i < num_before / 20; ++i) {
      mesh.triangles.erase(mesh.triangles.begin() +
                           static_cast<int>(random() % mesh.triangles.size()));
    }
    ASSERT_FALSE(CheckMesh(mesh).is_closed);
    const MeshReport report = MakeUsable(mesh).report;  // a triangle may be left alone in a hole
    EXPECT_EQ(FormatProblems(report), "");
    EXPECT_NEAR(report.volume, CalcVolume(ball), 1e-3 * report.volume);
  }
}

// The largest hole that is closed without asking, by its area, changes the volume by less than 0.1
// %; by a cap of a ball: V = pi h^2 (3 R - h) / 3, area of the rim's disc pi (2 R h - h^2).
TEST(FillHolesTest, WhatIsClosedWithoutAskingHardlyChangesTheVolume) {
  const TriMesh whole = MakeSphere(0.02, 96);
  double largest = 0.0;
  for (double z = 0.0199; z > 0.018; z -= 0.0001) {
    TriMesh mesh = TakeFaces(whole, [&](const Eigen::Vector3d& p) { return p.z() < z; });
    if (FillHoles(kMaxMendedHole, mesh) == 0) break;
    EXPECT_EQ(FormatProblems(CheckMesh(mesh)), "");
    largest = std::max(largest, 1.0 - CalcVolume(mesh) / CalcVolume(whole));
  }
  EXPECT_GT(largest, 4e-5);
  EXPECT_LT(largest, 1e-3);
}

TEST(FillHolesTest, AnOpenBodyStaysOpen) {
  TriMesh half = TakeFaces(MakeBall(), [](const Eigen::Vector3d& p) { return p.z() < 0.0; });
  EXPECT_EQ(FillHoles(kMaxRepairedHole, half), 0);
  TriMesh sheet;
  sheet.vertices = {{0, 0, 0}, {0.01, 0, 0}, {0.01, 0.01, 0}, {0, 0.01, 0}};
  sheet.triangles = {{0, 1, 2}, {0, 2, 3}};
  EXPECT_EQ(FillHoles(kMaxRepairedHole, sheet), 0);
  EXPECT_EQ(sheet.num_vertices(), 4);
  TriMesh none;
  EXPECT_EQ(FillHoles(1.0, none), 0);
  EXPECT_EQ(SewSeams(0.001, none), 0);
}

// One side of a box has its edges whole, its neighbours have theirs in two.
TEST(FillHolesTest, SlitsOfAnyLengthAreClosed) {
  TriMesh box;
  const double a = 0.04, b = 0.03, c = 0.02;
  box.vertices = {{0, 0, 0}, {a, 0, 0}, {a, b, 0}, {0, b, 0},         {0, 0, c},
                  {a, 0, c}, {a, b, c}, {0, b, c}, {0.5 * a, 0.0, c}, {a, 0.5 * b, c}};
  box.triangles = {{0, 2, 1}, {0, 3, 2}, {4, 5, 6}, {4, 6, 7}, {2, 3, 7}, {2, 7, 6}, {3, 0, 4},
                   {3, 4, 7}, {0, 1, 8}, {0, 8, 4}, {1, 5, 8}, {1, 2, 9}, {1, 9, 5}, {2, 6, 9}};
  EXPECT_EQ(CheckMesh(box).num_open_edges, 6);
  EXPECT_EQ(FillHoles(kMaxMendedHole, box), 2);
  const MeshReport report = CheckMesh(box);
  EXPECT_EQ(FormatProblems(report), "");
  EXPECT_NEAR(report.volume, a * b * c, 1e-15);
}

TEST(FillHolesTest, SeamsAreSewnWithinTheirTolerance) {
  const TriMesh upper = TakeFaces(MakeBall(), [](const Eigen::Vector3d& p) { return p.z() > 0.0; });
  const TriMesh lower =
      TakeFaces(MakeBall(), [](const Eigen::Vector3d& p) { return p.z() <= 0.0; });
  const TriMesh gaping = JoinMeshes(upper, lower, {0.0, 0.0, -2e-5});
  TriMesh mesh = gaping;
  EXPECT_EQ(SewSeams(1e-5, mesh), 0);
  EXPECT_EQ(mesh.num_vertices(), gaping.num_vertices());
  EXPECT_GT(SewSeams(3e-5, mesh), 20);
  EXPECT_EQ(FormatProblems(CheckMesh(mesh)), "");
  EXPECT_NEAR(CalcVolume(mesh), CalcVolume(MakeBall()), 1e-3 * CalcVolume(mesh));
  EXPECT_EQ(SewSeams(3e-5, mesh), 0);  // whole

  EXPECT_EQ(FormatProblems(MakeUsable(gaping).report), "");
}

}  // namespace
}  // namespace graspbench
