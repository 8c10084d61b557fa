#include "core/shape/repair/mesh_repair.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>

#include "core/shape/mass_properties.h"
#include "core/shape/primitives.h"
#include "core/shape/repair/mesh_check.h"
#include "core/shape/repair/mesh_topology.h"
#include "tests/core/shape/join_meshes.h"

namespace graspbench {
namespace {

TriMesh MakeBall() { return MakeSphere(0.02, 24); }

void ExpectRepaired(const TriMesh& broken, const std::vector<std::string>& actions, double volume,
                    double relative_tolerance) {
  EXPECT_NE(FormatProblems(CheckMesh(broken)), "");
  const MeshRepair repair = RepairMesh(broken);
  EXPECT_EQ(repair.actions, actions);
  EXPECT_EQ(FormatProblems(CheckMesh(repair.mesh)), "");
  EXPECT_NEAR(CalcVolume(repair.mesh), volume, relative_tolerance * volume);
}

TEST(MeshRepairTest, AGoodMeshStaysAsItIs) {
  const TriMesh ball = MakeBall();
  const MeshRepair repair = RepairMesh(ball);
  EXPECT_TRUE(repair.actions.empty());
  EXPECT_EQ(repair.mesh.triangles, ball.triangles);
}

TEST(MeshRepairTest, ClosesSmallHoles) {
  TriMesh broken = MakeBall();
  // One triangle, and elsewhere a patch of two.
  broken.triangles.erase(broken.triangles.begin() + 200, broken.triangles.begin() + 202);
  broken.triangles.erase(broken.triangles.begin() + 40);
  ExpectRepaired(broken, {"2 holes closed"}, CalcVolume(MakeBall()), 1e-2);
}

TEST(MeshRepairTest, LeavesALargeHoleOpen) {
  TriMesh broken = MakeBall();
  broken.triangles.resize(broken.triangles.size() / 2);
  const MeshRepair repair = RepairMesh(broken);
  EXPECT_EQ(CheckMesh(repair.mesh).num_open_edges, 24);
}

TEST(MeshRepairTest, TurnsFlippedFacesAndTheWholeSkin) {
  TriMesh one = MakeBall();
  std::swap(one.triangles[7][0], one.triangles[7][1]);
  ExpectRepaired(one, {"1 triangle flipped to face like its neighbours"}, CalcVolume(MakeBall()),
                 1e-12);
  TriMesh all = MakeBall();
  for (Eigen::Vector3i& t : all.triangles) std::swap(t[0], t[1]);
  ExpectRepaired(all, {"1 shell turned the right way round"}, CalcVolume(MakeBall()), 1e-12);
}

TEST(MeshRepairTest, FacingOutwardsChangesNothingElse) {
  TriMesh half = MakeBall();
  half.triangles.resize(half.triangles.size() / 2);
  EXPECT_TRUE(FaceOutwards(half).actions.empty());
  std::swap(half.triangles[7][0], half.triangles[7][1]);
  const MeshRepair turned = FaceOutwards(half);
  EXPECT_EQ(turned.actions,
            std::vector<std::string>{"1 triangle flipped to face like its neighbours"});
  EXPECT_EQ(turned.mesh.num_triangles(), half.num_triangles()) << "the hole stays open";
  TriMesh all = MakeBall();
  for (Eigen::Vector3i& t : all.triangles) std::swap(t[0], t[1]);
  EXPECT_NEAR(CalcVolume(FaceOutwards(all).mesh), CalcVolume(MakeBall()), 1e-12);
}

TEST(MeshRepairTest, ACavityStaysACavity) {
  TriMesh hollow = MakeBall();
  const TriMesh inner = MakeSphere(0.01, 24);
  const int first = hollow.num_vertices();
  hollow.vertices.insert(hollow.vertices.end(), inner.vertices.begin(), inner.vertices.end());
  for (Eigen::Vector3i t : inner.triangles) {
    std::swap(t[0], t[1]);
    hollow.triangles.push_back(t + Eigen::Vector3i::Constant(first));
  }
  const double volume = CalcVolume(hollow);
  EXPECT_NEAR(volume, CalcVolume(MakeBall()) - CalcVolume(inner), 1e-15);
  EXPECT_TRUE(RepairMesh(hollow).actions.empty());

  for (Eigen::Vector3i& t : hollow.triangles) std::swap(t[0], t[1]);
  EXPECT_NEAR(CalcVolume(RepairMesh(hollow).mesh), volume, 1e-15);
}

TEST(MeshRepairTest, MergesSplitVerticesAndDropsCopiesAndSlivers) {
  // Every triangle with vertices of its own, as STL has them; one copy, one sliver.
  const TriMesh ball = MakeBall();
  TriMesh soup;
  for (const Eigen::Vector3i& t : ball.triangles) {
    const int first = soup.num_vertices();
    for (int k = 0; k < 3; ++k) soup.vertices.push_back(ball.vertices[t[k]]);
    soup.triangles.emplace_back(first, first + 1, first + 2);
  }
  soup.triangles.push_back(soup.triangles[5]);
  soup.triangles.emplace_back(0, 1, 1);
  const MeshRepair repair = RepairMesh(soup);
  EXPECT_EQ(FormatProblems(CheckMesh(repair.mesh)), "");
  EXPECT_EQ(repair.mesh.num_vertices(), ball.num_vertices());
  EXPECT_EQ(repair.mesh.num_triangles(), ball.num_triangles());
}

// Two faces on each other in opposite directions enclose nothing; a sheet that hangs on an edge
// neither.
TEST(MeshRepairTest, FinsAreTakenOffAndTheSurfaceStaysClosed) {
  const TriMesh ball = MakeBall();
  const double volume = CalcVolume(ball);
  const Eigen::Vector3i t = ball.triangles[100];
  const int tip = ball.num_vertices();
  TriMesh doubled = ball;
  doubled.vertices.push_back(1.2 * ball.vertices[t[0]]);
  doubled.triangles.emplace_back(t[0], t[1], tip);
  doubled.triangles.emplace_back(t[1], t[0], tip);
  TriMesh hanging = doubled;
  hanging.triangles.pop_back();
  TriMesh sheet = hanging;  // of two triangles
  sheet.vertices.push_back(1.2 * ball.vertices[t[1]]);
  sheet.triangles.emplace_back(t[1], tip + 1, tip);
  for (const TriMesh& broken : {doubled, hanging, sheet}) {
    const UsableMesh usable = MakeUsable(broken);
    EXPECT_EQ(FormatProblems(usable.report), "");
    EXPECT_EQ(usable.actions.size(), 1u);
    EXPECT_NEAR(usable.report.volume, volume, 1e-12 * volume);
    EXPECT_EQ(usable.mesh.triangles, ball.triangles);
    EXPECT_EQ(usable.mesh.vertices, ball.vertices);  // the tip does not count for the size
    EXPECT_NEAR(usable.report.extent.maxCoeff(), 0.04, 1e-3);
  }
}

TEST(MeshRepairTest, FacesWrittenTwiceForPicturesAreHalved) {
  const TriMesh ball = MakeBall();
  TriMesh two_sided = ball;
  for (const Eigen::Vector3i& t : ball.triangles)
    two_sided.triangles.emplace_back(t[0], t[2], t[1]);
  const UsableMesh usable = MakeUsable(two_sided);
  EXPECT_EQ(FormatProblems(usable.report), "");
  EXPECT_EQ(usable.mesh.triangles, ball.triangles);
}

TEST(MeshRepairTest, OnlySmallHolesAreClosedWithoutAsking) {
  TriMesh small = MakeSphere(0.02, 64);
  small.triangles.erase(small.triangles.begin() + 300);
  EXPECT_EQ(MakeUsable(small).actions, std::vector<std::string>{"1 hole closed"});
  EXPECT_EQ(FormatProblems(MakeUsable(small).report), "");

  TriMesh large = MakeBall();  // the cap around its pole
  large.triangles.erase(
      std::remove_if(large.triangles.begin(), large.triangles.end(),
                     [&](const Eigen::Vector3i& t) {
                       return std::min({large.vertices[t[0]].z(), large.vertices[t[1]].z(),
                                        large.vertices[t[2]].z()}) > 0.019;
                     }),
      large.triangles.end());
  EXPECT_TRUE(MakeUsable(large).actions.empty());
  EXPECT_FALSE(MakeUsable(large).report.problems.empty());
  EXPECT_EQ(FormatProblems(CheckMesh(RepairMesh(large).mesh)), "");
}

// What can be used is not touched, whatever is tolerated about it.
TEST(MeshRepairTest, WhatCanBeUsedStaysAsItIs) {
  TriMesh crossed = MakeBall();
  const int first = crossed.num_vertices();
  for (const Eigen::Vector3d& p : MakeBall().vertices) {
    crossed.vertices.push_back(p + Eigen::Vector3d(0.01, 0.002, 0.001));
  }
  for (const Eigen::Vector3i& t : MakeBall().triangles) {
    crossed.triangles.push_back(t + Eigen::Vector3i::Constant(first));
  }
  const UsableMesh usable = MakeUsable(crossed);
  EXPECT_EQ(FormatProblems(usable.report), "");
  EXPECT_TRUE(usable.actions.empty());
  EXPECT_EQ(usable.mesh.triangles, crossed.triangles);
}

TEST(MeshRepairTest, ALargeSoupIsRefusedWithItsCountAndWhatToDo) {
  TriMesh soup;
  for (int i = 0; i <= kMaxMendedSoup; ++i) {
    const Eigen::Vector3d p(1e-4 * (i % 500), 1e-4 * (i / 500), 0.0);
    const int first = soup.num_vertices();
    soup.vertices.insert(soup.vertices.end(),
                         {p, p + Eigen::Vector3d(5e-5, 0, 0), p + Eigen::Vector3d(0, 5e-5, 0)});
    soup.triangles.emplace_back(first, first + 1, first + 2);
  }
  const UsableMesh usable = MakeUsable(soup);
  EXPECT_TRUE(usable.actions.empty());
  const std::string text = FormatProblems(usable.report);
  EXPECT_NE(text.find("with 200001 triangles"), std::string::npos) << text;
  EXPECT_NE(text.find("decimate"), std::string::npos) << text;
}

TEST(MeshRepairTest, HopelessInputComesBack) {
  EXPECT_TRUE(RepairMesh({}).actions.empty());
  TriMesh bad = MakeBall();
  bad.vertices[0].x() = NAN;
  EXPECT_TRUE(RepairMesh(bad).actions.empty());
  EXPECT_EQ(RepairMesh(bad).mesh.num_triangles(), bad.num_triangles());
}

TriMesh MakeSharpBlock() { return MakeRoundedBox({0.04, 0.03, 0.02}, 0.0); }

// The four sides of a box without the end at x = 0 or x = 1 of its length.
TriMesh MakeBoxWithoutEnd(double end) {
  TriMesh box = MakeSharpBlock();
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

TEST(MeshRepairTest, AWallAcrossTheInsideGoes) {
  const TriMesh left = MakeBoxWithoutEnd(1.0), right = MakeBoxWithoutEnd(0.0);
  TriMesh wall = MakeSharpBlock();
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
      for (Eigen::Vector3i& t : part.triangles) std::swap(t[0], t[1]);
    }
    TriMesh mesh = WeldVertices(JoinMeshes(JoinMeshes(left, right, {0.04, 0.0, 0.0}), part), 1e-9);
    EXPECT_FALSE(CheckMesh(mesh).problems.empty());
    const UsableMesh usable = MakeUsable(mesh);
    EXPECT_EQ(FormatProblems(usable.report), "");
    EXPECT_EQ(usable.mesh.num_triangles(), mesh.num_triangles() - wall.num_triangles());
    EXPECT_NEAR(CalcVolume(usable.mesh), 0.08 * 0.03 * 0.02, 1e-12);
  }
}

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
TEST(MeshRepairTest, ManyHolesThatTouchAreClosed) {
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
TEST(MeshRepairTest, WhatIsClosedWithoutAskingHardlyChangesTheVolume) {
  const TriMesh whole = MakeSphere(0.02, 96);
  double largest = 0.0;
  for (double z = 0.0199; z > 0.018; z -= 0.0001) {
    TriMesh mesh = TakeFaces(whole, [&](const Eigen::Vector3d& p) { return p.z() < z; });
    mesh = MendMesh(mesh).mesh;
    if (!CheckMesh(mesh).is_closed) break;
    EXPECT_EQ(FormatProblems(CheckMesh(mesh)), "");
    largest = std::max(largest, 1.0 - CalcVolume(mesh) / CalcVolume(whole));
  }
  EXPECT_GT(largest, 4e-5);
  EXPECT_LT(largest, 1e-3);
}

// One side of a box has its edges whole, its neighbours have theirs in two.
TEST(MeshRepairTest, SlitsOfAnyLengthAreClosed) {
  TriMesh box;
  const double a = 0.04, b = 0.03, c = 0.02;
  box.vertices = {{0, 0, 0}, {a, 0, 0}, {a, b, 0}, {0, b, 0},         {0, 0, c},
                  {a, 0, c}, {a, b, c}, {0, b, c}, {0.5 * a, 0.0, c}, {a, 0.5 * b, c}};
  box.triangles = {{0, 2, 1}, {0, 3, 2}, {4, 5, 6}, {4, 6, 7}, {2, 3, 7}, {2, 7, 6}, {3, 0, 4},
                   {3, 4, 7}, {0, 1, 8}, {0, 8, 4}, {1, 5, 8}, {1, 2, 9}, {1, 9, 5}, {2, 6, 9}};
  EXPECT_EQ(CheckMesh(box).num_open_edges, 6);
  const MeshReport report = MakeUsable(box).report;
  EXPECT_EQ(FormatProblems(report), "");
  EXPECT_NEAR(report.volume, a * b * c, 1e-15);
}

TEST(MeshRepairTest, SeamsAreSewnWithinTheirTolerance) {
  const TriMesh upper = TakeFaces(MakeBall(), [](const Eigen::Vector3d& p) { return p.z() > 0.0; });
  const TriMesh lower =
      TakeFaces(MakeBall(), [](const Eigen::Vector3d& p) { return p.z() <= 0.0; });
  const TriMesh gaping = JoinMeshes(upper, lower, {0.0, 0.0, -2e-5});
  const UsableMesh usable = MakeUsable(gaping);
  EXPECT_EQ(FormatProblems(usable.report), "");
  EXPECT_NEAR(CalcVolume(usable.mesh), CalcVolume(MakeBall()), 1e-3 * CalcVolume(usable.mesh));
  // 50 micrometres are more than a seam of a thing of 40 mm.
  const TriMesh apart = JoinMeshes(upper, lower, {0.0, 0.0, -5e-5});
  EXPECT_NE(FormatProblems(MakeUsable(apart).report), "");
}

}  // namespace
}  // namespace graspbench
