#include "core/shape/repair/mesh_repair.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/shape/mass_properties.h"
#include "core/shape/primitives.h"
#include "core/shape/repair/mesh_check.h"

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

}  // namespace
}  // namespace graspbench
