#include "core/shape/repair/mesh_check.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "core/base/units.h"
#include "core/shape/primitives.h"
#include "core/shape/repair/mesh_repair.h"
#include "core/shape/repair/mesh_topology.h"
#include "tests/core/shape/join_meshes.h"

namespace graspbench {
namespace {

TriMesh MakeBox() { return MakeRoundedBox({0.04, 0.03, 0.02}, 0.0); }

std::vector<MeshFault> FaultsOf(const MeshReport& report) {
  std::vector<MeshFault> faults;
  for (const MeshProblem& problem : report.problems) faults.push_back(problem.fault);
  return faults;
}

TEST(MeshCheckTest, AGoodBoxHasNoProblems) {
  const MeshReport report = CheckMesh(MakeBox());
  EXPECT_EQ(FormatProblems(report), "");
  EXPECT_TRUE(report.is_closed);
  EXPECT_EQ(report.num_open_edges, 0);
  EXPECT_NEAR(report.volume, 0.04 * 0.03 * 0.02, 1e-15);
  EXPECT_LT(report.centroid.norm(), 1e-15);
  EXPECT_LT((report.extent - Eigen::Vector3d(0.04, 0.03, 0.02)).norm(), 1e-15);
}

TEST(MeshCheckTest, AMissingFaceLeavesThreeOpenEdgesAndTheirPlaces) {
  TriMesh box = MakeBox();
  const Eigen::Vector3i lost = box.triangles[0];
  box.triangles.erase(box.triangles.begin());
  const MeshReport report = CheckMesh(box);
  EXPECT_EQ(FaultsOf(report), std::vector<MeshFault>{MeshFault::kOpen});
  EXPECT_FALSE(report.is_closed);
  EXPECT_EQ(report.num_open_edges, 3);
  EXPECT_TRUE(std::isnan(report.volume));
  const std::string text = FormatProblems(report);
  EXPECT_NE(text.find("the surface is open: 3 edges have a triangle on one side only: ("),
            std::string::npos)
      << text;
  char corner[64];
  const Eigen::Vector3d p = 1e3 * box.vertices[lost[0]];
  std::snprintf(corner, sizeof corner, "(%.4g, %.4g, %.4g)", p.x(), p.y(), p.z());
  EXPECT_NE(text.find(corner), std::string::npos) << text << " lacks " << corner;
}

TEST(MeshCheckTest, InsideOutIsToldFromOneFlippedFace) {
  TriMesh inverted = MakeBox();
  for (Eigen::Vector3i& t : inverted.triangles) std::swap(t[1], t[2]);
  const MeshReport report = CheckMesh(inverted);
  EXPECT_TRUE(report.is_closed);
  EXPECT_LT(report.volume, 0.0);
  EXPECT_EQ(FormatProblems(report),
            "the mesh is inside out: all its faces point inwards; flip them, or repair");

  TriMesh one_flipped = MakeBox();
  std::swap(one_flipped.triangles[3][1], one_flipped.triangles[3][2]);
  const MeshReport other = CheckMesh(one_flipped);
  EXPECT_TRUE(other.is_closed);
  EXPECT_EQ(FaultsOf(other), std::vector<MeshFault>{MeshFault::kInconsistent});
  EXPECT_EQ(FormatProblems(other).find("3 edges join triangles that face opposite ways: ("), 0u);
}

TEST(MeshCheckTest, TwoBoxesThroughEachOtherAreOneBody) {
  TriMesh crossed = MakeBox();
  const Eigen::Vector3d offset(0.013, 0.011, 0.007), size(0.04, 0.03, 0.02);
  crossed = JoinMeshes(crossed, MakeBox(), offset);
  const MeshReport report = CheckMesh(crossed);
  EXPECT_EQ(FormatProblems(report), "");
  // Each box counts, what lies in both counts once.
  const double shared = (size - offset).prod(), expected = 2.0 * size.prod() - shared;
  EXPECT_NEAR(report.volume, expected, 1e-3 * shared);
  EXPECT_NEAR(report.overlap.absolute_volume, shared, 1e-3 * shared);
  EXPECT_LT((report.centroid - 0.5 * offset).norm(), 1e-5);
  ASSERT_EQ(report.warnings.size(), 1u);
  EXPECT_NE(report.warnings[0].find("triangles cut through each other: face "), std::string::npos);
  EXPECT_NE(report.warnings[0].find("% of the volume lies in several parts"), std::string::npos);

  TriMesh apart = MakeBox();
  apart = JoinMeshes(apart, MakeBox(), {0.05, 0.0, 0.0});
  EXPECT_EQ(FaultsOf(CheckMesh(apart)), std::vector<MeshFault>{MeshFault::kApart});
  const MeshReport meant = CheckMesh(apart, PartsApart::kMeant);
  EXPECT_EQ(FormatProblems(meant), "");
  EXPECT_EQ(meant.warnings.size(), 1u);
  EXPECT_NEAR(meant.volume, 2.0 * size.prod(), 1e-12);
}

TEST(MeshCheckTest, WhatIsThinnerThanPaperIsDoubted) {
  for (const auto& [thickness, is_doubted] : {std::pair(1e-4, false), {1e-7, true}}) {
    const MeshReport report = CheckMesh(MakeRoundedBox({0.04, 0.04, thickness}, 0.0));
    EXPECT_EQ(!report.warnings.empty(), is_doubted) << thickness;
  }
}

TEST(MeshCheckTest, AMeshTooLargeToPrepareIsRefusedWithItsCountAndWhatToDo) {
  TriMesh large = MakeBox();
  large.triangles.resize(600'001, large.triangles[0]);
  const UsableMesh usable = MakeUsable(large);
  EXPECT_EQ(FaultsOf(usable.report), std::vector<MeshFault>{MeshFault::kTooMany});
  EXPECT_NE(FormatProblems(usable.report).find("has 600001 triangles, and at most 600000 can be"),
            std::string::npos);
  EXPECT_NE(FormatProblems(usable.report).find("decimate"), std::string::npos);
  EXPECT_TRUE(RepairMesh(large).actions.empty());
}

/** A cube that has this share of the volume of the box and itself. */
TriMesh MakeCrumb(double share) {
  const double side = std::cbrt(share / (1.0 - share) * 0.04 * 0.03 * 0.02);
  return MakeRoundedBox({side, side, side}, 0.0);
}

// The box is 40 mm long, so that what is 0.04 mm away touches it.
/** Two cones of so many faces with one base. */
TriMesh MakeTwoCones(int num_faces) {
  TriMesh mesh;
  mesh.vertices = {{0.0, 0.0, 0.04}, {0.0, 0.0, -0.04}};
  for (int i = 0; i < num_faces; ++i) {
    const double angle = 2.0 * kPi * i / num_faces;
    mesh.vertices.emplace_back(0.03 * std::cos(angle), 0.03 * std::sin(angle), 0.0);
    const int here = i + 2, next = (i + 1) % num_faces + 2;
    mesh.triangles.emplace_back(0, here, next);
    mesh.triangles.emplace_back(1, next, here);
  }
  return mesh;
}

// Of n faces that meet in one corner, n * n lie in each other's boxes.
TEST(MeshCheckTest, FacesThatCrowdInOneCornerAreRefusedWithTheirCount) {
  EXPECT_EQ(FormatProblems(CheckMesh(MakeTwoCones(2000))), "");
  EXPECT_EQ(FormatProblems(CheckMesh(MakeTwoCones(20'000))),
            "the mesh has 40000 triangles, 20000 of them at the corner (0, 0, 40) [mm]: it takes "
            "more than 50000000 tests to tell whether they cross; reduce it (decimate) in a "
            "modelling program");
}

TEST(MeshCheckTest, AFloatingCrumbIsRefusedOrTold) {
  const MeshReport large = CheckMesh(JoinMeshes(MakeBox(), MakeCrumb(0.011), {0.04, 0.0, 0.0}));
  EXPECT_EQ(FaultsOf(large), std::vector<MeshFault>{MeshFault::kApart});
  EXPECT_EQ(FormatProblems(large).find("1 part with 1.1 % of the volume, the first at ("), 0u)
      << FormatProblems(large);
  const TriMesh small = JoinMeshes(MakeBox(), MakeCrumb(0.009), {0.04, 0.0, 0.0});
  EXPECT_EQ(FormatProblems(CheckMesh(small)), "");
  ASSERT_EQ(CheckMesh(small).warnings.size(), 1u);
  EXPECT_NE(CheckMesh(small).warnings[0].find("apart from the rest"), std::string::npos);
  // Together they are as large as one that is refused.
  const TriMesh two = JoinMeshes(small, MakeCrumb(0.009), {-0.04, 0.0, 0.0});
  EXPECT_EQ(FormatProblems(CheckMesh(two)).find("2 parts with 1.78 % of the volume"), 0u);
}

TEST(MeshCheckTest, PartsThatTouchAreOneBody) {
  const TriMesh crumb = MakeCrumb(0.05);
  const double half = 0.5 * std::cbrt(0.05 / 0.95 * 0.04 * 0.03 * 0.02);
  for (const auto& [gap, is_apart] : {std::pair(0.0, false), {3e-5, false}, {3e-4, true}}) {
    const TriMesh beside = JoinMeshes(MakeBox(), crumb, {0.02 + half + gap, 0.003, 0.002});
    EXPECT_EQ(!CheckMesh(beside).problems.empty(), is_apart) << gap;
  }
  // The tolerance does not grow with the object: of an arm it would join what is 0.6 mm apart.
  const TriMesh bar = MakeRoundedBox({0.3, 0.02, 0.02}, 0.0);
  for (const auto& [gap, is_apart] : {std::pair(3e-5, false), {1e-4, true}}) {
    const TriMesh row = JoinMeshes(bar, bar, {0.3 + gap, 0.0, 0.0});
    EXPECT_EQ(!CheckMesh(row).problems.empty(), is_apart) << gap;
  }
  // Two bars across each other: no corner of one is near a face of the other.
  const TriMesh along = MakeRoundedBox({0.1, 0.01, 0.01}, 0.0),
                across = MakeRoundedBox({0.01, 0.1, 0.01}, 0.0);
  EXPECT_EQ(FormatProblems(CheckMesh(JoinMeshes(along, across, {0.0, 0.0, 0.01}))), "");
  EXPECT_EQ(FormatProblems(CheckMesh(JoinMeshes(along, across, {0.003, 0.0, 0.005}))), "");
  EXPECT_EQ(FaultsOf(CheckMesh(JoinMeshes(along, across, {0.0, 0.0, 0.012}))),
            std::vector<MeshFault>{MeshFault::kApart});
}

// What rattles in a hollow is as loose as what lies beside it.
TEST(MeshCheckTest, ABodyInACavityIsApart) {
  TriMesh cavity = MakeRoundedBox({0.03, 0.02, 0.015}, 0.0);
  for (Eigen::Vector3i& t : cavity.triangles) std::swap(t[0], t[1]);
  const TriMesh hollow = JoinMeshes(MakeBox(), cavity);
  EXPECT_EQ(FormatProblems(CheckMesh(hollow)), "");
  EXPECT_EQ(FaultsOf(CheckMesh(JoinMeshes(hollow, MakeCrumb(0.05)))),
            std::vector<MeshFault>{MeshFault::kApart});
}

TEST(MeshCheckTest, PartsInEachOtherAreOneBodyOrHollow) {
  TriMesh inner = MakeBox();
  for (Eigen::Vector3d& p : inner.vertices) p *= 0.5;
  const double outer_volume = 0.04 * 0.03 * 0.02, inner_volume = outer_volume / 8.0;
  TriMesh solid = MakeBox();
  solid = JoinMeshes(solid, inner, {0.001, 0.0, 0.0});
  const MeshReport twice = CheckMesh(solid);  // is it solid or hollow? Nobody can tell
  EXPECT_EQ(FaultsOf(twice), std::vector<MeshFault>{MeshFault::kNested});
  EXPECT_NE(FormatProblems(twice).find("1 part with 12.5 % of the volume"), std::string::npos);
  EXPECT_NEAR(twice.volume, outer_volume, 2e-3 * inner_volume);

  for (Eigen::Vector3i& t : inner.triangles) std::swap(t[0], t[1]);
  TriMesh hollow = MakeBox();
  hollow = JoinMeshes(hollow, inner, {0.001, 0.0, 0.0});
  EXPECT_EQ(FormatProblems(CheckMesh(hollow)), "");
  EXPECT_TRUE(CheckMesh(hollow).warnings.empty());
  EXPECT_NEAR(CheckMesh(hollow).volume, outer_volume - inner_volume, 1e-12);

  TriMesh beside = MakeBox();
  beside = JoinMeshes(beside, inner, {0.05, 0.0, 0.0});
  EXPECT_EQ(FormatProblems(CheckMesh(beside)),
            "1 of 2 parts are inside out; flip their faces, or repair");
}

// A part that faces inwards is a cavity only where it lies in another one altogether.
TEST(MeshCheckTest, AnInvertedPartThatSticksOutIsNoCavity) {
  const TriMesh box = MakeBox();
  TriMesh turned = MakeRoundedBox({0.03, 0.03, 0.02}, 0.0);
  for (Eigen::Vector3i& t : turned.triangles) std::swap(t[0], t[1]);
  const TriMesh crossed = JoinMeshes(box, turned, {0.025, 0.011, 0.007});
  const MeshReport report = CheckMesh(crossed);
  ASSERT_FALSE(report.problems.empty());
  EXPECT_EQ(report.problems[0].text, "1 of 2 parts are inside out; flip their faces, or repair");
  const MeshRepair repair = RepairMesh(crossed);
  const double sizes = 0.07 * 0.03 * 0.02, shared = 0.01 * 0.019 * 0.013;
  EXPECT_EQ(repair.actions, std::vector<std::string>{"1 shell turned the right way round"});
  EXPECT_NEAR(CheckMesh(repair.mesh).volume, sizes - shared, 1e-4 * sizes);
}

// More parts than can be looked at one pair at a time, in a chain: each shares a slice with the
// next.
TEST(MeshCheckTest, AHundredPartsAreOneBody) {
  TriMesh chain;
  for (int i = 0; i < 100; ++i) {
    chain = JoinMeshes(chain, MakeRoundedBox({0.005, 0.03, 0.02}, 0.0),
                       {0.004 * i, 1e-4 * (i % 3), 2e-4 * (i % 2)});
  }
  const MeshReport report = CheckMesh(chain);
  EXPECT_EQ(FormatProblems(report), "");
  double expected = 0.0;  // every box without what it shares with the one before
  for (int i = 0; i < 100; ++i) {
    const double shift_y = i % 3 == 0 ? 2e-4 : 1e-4;
    expected += 0.005 * 0.03 * 0.02;
    if (i > 0) expected -= 0.001 * (0.03 - shift_y) * (0.02 - 2e-4);
  }
  EXPECT_NEAR(report.volume, expected, 1e-4 * expected);
}

// A bar along x of two cells, from `start` cells on.
TriMesh MakeBar(double cell, int start) {
  TriMesh bar;
  for (int ring = 0; ring < 3; ++ring) {
    const double x = (start + ring) * cell;
    for (const auto& [y, z] : {std::pair(0, 0), {1, 0}, {1, 1}, {0, 1}}) {
      bar.vertices.emplace_back(x, y * cell, z * cell);
    }
  }
  const auto add_quad = [&](int a, int b, int c, int d) {
    bar.triangles.emplace_back(a, b, c);
    bar.triangles.emplace_back(a, c, d);
  };
  add_quad(0, 3, 2, 1);
  add_quad(8, 9, 10, 11);
  for (int first : {0, 4}) {
    for (int k = 0; k < 4; ++k) {
      add_quad(first + k, first + (k + 1) % 4, first + 4 + (k + 1) % 4, first + 4 + k);
    }
  }
  return bar;
}

// Bars half in each other whose sides coincide: every face counts, the volume once.
TEST(MeshCheckTest, BodiesThatShareFacesAreUnited) {
  const double cell = 0.02;
  const TriMesh both = WeldVertices(JoinMeshes(MakeBar(cell, 0), MakeBar(cell, 1)), 1e-9);
  const MeshReport report = CheckMesh(both);
  EXPECT_EQ(FormatProblems(report), "");
  EXPECT_NEAR(report.volume, 3.0 * std::pow(cell, 3), 1e-4 * report.volume);
  ASSERT_FALSE(report.warnings.empty());
  EXPECT_EQ(report.warnings[0].find("8 triangles are part of several bodies: face "), 0u);
  EXPECT_TRUE(MakeUsable(both).actions.empty());

  // Nobody needs both of these.
  const TriMesh bar = MakeBar(cell, 0);
  const UsableMesh twice = MakeUsable(WeldVertices(JoinMeshes(bar, bar), 1e-9));
  EXPECT_EQ(FormatProblems(twice.report), "");
  EXPECT_EQ(twice.actions, std::vector<std::string>{"20 doubled triangles dropped"});
  EXPECT_NEAR(twice.report.volume, 2.0 * std::pow(cell, 3), 1e-15);
}

// Boxes that share an edge, or a face that each of them has.
TEST(MeshCheckTest, TouchingPartsAreOneBody) {
  for (const Eigen::Vector3d& offset :
       {Eigen::Vector3d(0.04, 0.03, 0.0), Eigen::Vector3d(0.04, 0.0, 0.0),
        Eigen::Vector3d(0.04, 0.011, 0.003)}) {
    TriMesh touching = MakeBox();
    touching = JoinMeshes(touching, MakeBox(), offset);
    for (const TriMesh& mesh : {touching, WeldVertices(touching, 1e-9)}) {
      const UsableMesh usable = MakeUsable(mesh);
      EXPECT_EQ(FormatProblems(usable.report), "") << offset.transpose();
      EXPECT_NEAR(usable.report.volume, 2.0 * 0.04 * 0.03 * 0.02, 1e-10) << offset.transpose();
    }
  }
}

// A vertex pulled through the opposite side: the crossing triangles share no corner with the side.
// What comes out there is inside out.
TEST(MeshCheckTest, ASmallFoldIsToleratedALargeOneIsNot) {
  TriMesh sphere = MakeSphere(0.02, 16);
  sphere.vertices.back() = Eigen::Vector3d(0.001, 0.0005, -0.03);
  const MeshReport small = CheckMesh(sphere);
  EXPECT_EQ(FormatProblems(small), "");
  ASSERT_EQ(small.warnings.size(), 1u);
  EXPECT_NE(small.warnings[0].find("cut through each other"), std::string::npos);
  EXPECT_GT(small.overlap.absolute_volume, 0.0);
  EXPECT_LT(small.overlap.absolute_volume, 1e-3 * small.volume);

  TriMesh coarse = MakeSphere(0.02, 6);
  coarse.vertices.back() = Eigen::Vector3d(0.001, 0.0005, -0.06);
  ASSERT_FALSE(CheckMesh(coarse).problems.empty());
  EXPECT_EQ(CheckMesh(coarse).problems.back().fault, MeshFault::kSelfCrossing);
}

TEST(MeshCheckTest, EmptyAndNotFinite) {
  EXPECT_EQ(FormatProblems(CheckMesh({})),
            "the mesh has no triangles; export faces, not points, lines or an empty scene");
  TriMesh box = MakeBox();
  box.vertices[2].y() = NAN;
  box.vertices[5].x() = INFINITY;
  EXPECT_EQ(FormatProblems(CheckMesh(box)),
            "2 vertices are not made of finite numbers: vertex 3, vertex 6; export "
            "the mesh again");
}

TEST(MeshCheckTest, WrongUnitsAreGuessed) {
  TriMesh huge = MakeBox(), tiny = MakeBox();
  for (Eigen::Vector3d& p : huge.vertices) p *= 1000.0;
  for (Eigen::Vector3d& p : tiny.vertices) p *= 0.001;
  EXPECT_EQ(FormatProblems(CheckMesh(huge)),
            "the mesh is 40 m long; a thing to grasp measures 2 mm to 1 m. If its numbers are "
            "millimetres, say so (unit mm); else scale it");
  EXPECT_EQ(FormatProblems(CheckMesh(tiny)),
            "the mesh is 0.04 mm long; a thing to grasp measures 2 mm to 1 m. If its numbers are "
            "metres, say so (unit m); else scale it");
}

TEST(MeshCheckTest, SliversAndCopies) {
  TriMesh sliver = MakeBox();
  sliver.vertices.push_back(0.5 * (sliver.vertices[0] + sliver.vertices[1]));
  sliver.triangles.emplace_back(0, 1, sliver.num_vertices() - 1);
  ASSERT_FALSE(CheckMesh(sliver).warnings.empty());
  EXPECT_EQ(CheckMesh(sliver).warnings[0].find("1 triangle has no area: face 17 at ("), 0u);
  const UsableMesh mended = MakeUsable(sliver);
  EXPECT_EQ(FormatProblems(mended.report), "");
  EXPECT_EQ(mended.actions,
            std::vector<std::string>{"1 triangle that only hangs on the surface dropped"});

  TriMesh copied = MakeBox();
  copied.triangles.push_back(copied.triangles[4]);
  EXPECT_EQ(FaultsOf(CheckMesh(copied)),
            (std::vector<MeshFault>{MeshFault::kDuplicate, MeshFault::kNotManifold}));
}

TEST(MeshCheckTest, AFlatSheetOfTwoSidesEnclosesNothing) {
  TriMesh sheet;
  sheet.vertices = {{0, 0, 0}, {0.05, 0, 0}, {0.05, 0.05, 0}, {0, 0.05, 0}};
  sheet.triangles = {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}};
  EXPECT_EQ(FormatProblems(CheckMesh(sheet)),
            "the mesh encloses no volume; give it thickness in a modelling program");
}

}  // namespace
}  // namespace graspbench
