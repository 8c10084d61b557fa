#include "core/shape/mass_properties.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/pose.h"
#include "core/base/units.h"
#include "core/shape/primitives.h"
#include "tests/core/shape/join_meshes.h"

namespace graspbench {
namespace {

TriMesh MakeMoved(TriMesh mesh, const Pose& X) {
  for (Eigen::Vector3d& p : mesh.vertices) p = X * p;
  return mesh;
}

TEST(MassPropertiesTest, BoxInClosedForm) {
  const Eigen::Vector3d size(0.1, 0.2, 0.3);
  const TriMesh box = MakeRoundedBox(size, 0.0);
  const MassProperties found = CalcSolidMassProperties(box, 6.0);
  EXPECT_NEAR(CalcVolume(box), 0.006, 1e-15);
  EXPECT_EQ(found.mass, 6.0);
  EXPECT_LT(found.p_OOcm.norm(), 1e-15);
  // m/12 (b^2 + c^2)
  const Eigen::Vector3d expected = 0.5 * Eigen::Vector3d(0.13, 0.10, 0.05);
  EXPECT_LT((found.I_OOcm - Eigen::Matrix3d(expected.asDiagonal())).norm(), 1e-15);
}

TEST(MassPropertiesTest, CornerTetrahedronInClosedForm) {
  TriMesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  EXPECT_NEAR(CalcVolume(mesh), 1.0 / 6.0, 1e-15);
  const MassProperties found = CalcSolidMassProperties(mesh, 1.0);
  EXPECT_LT((found.p_OOcm - Eigen::Vector3d::Constant(0.25)).norm(), 1e-15);
  // Second moments over the unit corner tetrahedron: E[x^2] = 1/10, E[xy] = 1/20.
  const double diagonal = 2.0 * (0.1 - 0.0625);
  const double off_diagonal = -(0.05 - 0.0625);
  EXPECT_NEAR(found.I_OOcm(0, 0), diagonal, 1e-15);
  EXPECT_NEAR(found.I_OOcm(0, 1), off_diagonal, 1e-15);
  EXPECT_NEAR(found.I_OOcm(1, 2), off_diagonal, 1e-15);
}

// A polyhedron inscribed in a sphere errs by O(1/n^2): the error falls by four per doubling.
TEST(MassPropertiesTest, SphereConvergesToItsClosedForm) {
  const double radius = 0.05;
  const double expected = 0.4 * radius * radius;
  double previous = 0.0;
  for (const int num_segments : {16, 32, 64}) {
    const Eigen::Matrix3d I = CalcSolidMassProperties(MakeSphere(radius, num_segments), 1.0).I_OOcm;
    const double error = expected - I.trace() / 3.0;
    EXPECT_GT(error, 0.0);
    if (previous > 0.0) {
      EXPECT_NEAR(previous / error, 4.0, 0.2);
    }
    previous = error;
  }
  EXPECT_LT(previous / expected, 0.01);
}

TEST(MassPropertiesTest, MovingTheMeshMovesTheTensor) {
  const TriMesh mesh = MakeTaperedCapsule({0.01, 0.0, 0.0}, 0.02, {0.03, 0.05, 0.01}, 0.01);
  const MassProperties at_home = CalcSolidMassProperties(mesh, 0.3);
  const Pose X = MakePose(MakeRotationRpy(0.3, -1.1, 2.0), {5.0, -3.0, 0.7});
  const MassProperties moved = CalcSolidMassProperties(MakeMoved(mesh, X), 0.3);
  EXPECT_LT((moved.p_OOcm - X * at_home.p_OOcm).norm(), 1e-13);
  const Eigen::Matrix3d expected = X.linear() * at_home.I_OOcm * X.linear().transpose();
  EXPECT_LT((moved.I_OOcm - expected).norm(), 1e-11 * expected.norm());
}

TEST(MassPropertiesTest, InsideOutHasNegativeVolume) {
  TriMesh box = MakeRoundedBox({1, 1, 1}, 0.0);
  for (Eigen::Vector3i& t : box.triangles) std::swap(t[1], t[2]);
  EXPECT_NEAR(CalcVolume(box), -1.0, 1e-15);
}

TEST(OverlapTest, ASimpleBodyHasNone) {
  EXPECT_EQ(CalcOverlap(MakeSphere(0.02, 48)).absolute_volume, 0.0);
  EXPECT_EQ(CalcOverlap({}).absolute_volume, 0.0);
}

// The lens of two balls (Weisstein, "Sphere-sphere intersection").
TEST(OverlapTest, TwoBallsShareALens) {
  const double r = 0.02, d = 0.025;
  const Overlap overlap =
      CalcOverlap(JoinMeshes(MakeSphere(r, 128), MakeSphere(r, 128), {d, 0.0, 0.0}));
  const double lens = kPi * (4.0 * r + d) * (2.0 * r - d) * (2.0 * r - d) / 12.0;
  EXPECT_NEAR(overlap.volume, lens, 5e-3 * lens);
  EXPECT_NEAR(overlap.absolute_volume, lens, 5e-3 * lens);
}

// Closed forms: sides along the axes are the worst case for lines on a grid.
TEST(OverlapTest, TwoBoxesShareABox) {
  const Eigen::Vector3d size(0.04, 0.03, 0.02);
  for (const Eigen::Vector3d& offset :
       {Eigen::Vector3d(0.02, 0.01, 0.005), Eigen::Vector3d(0.02, 0.0, 0.0),
        Eigen::Vector3d(0.0, 0.0, 0.01), Eigen::Vector3d(0.0001, 0.0001, 0.0)}) {
    const TriMesh box = MakeRoundedBox(size, 0.0);
    const Overlap overlap = CalcOverlap(JoinMeshes(box, box, offset));
    const double both = 2.0 * size.prod() - (size - offset).prod();
    EXPECT_NEAR(overlap.volume, (size - offset).prod(), 1e-4 * both) << offset.transpose();
    EXPECT_EQ(overlap.inverted_volume, 0.0);
  }
}

TEST(OverlapTest, WhatIsInsideOutIsToldApart) {
  const TriMesh box = MakeRoundedBox({0.04, 0.03, 0.02}, 0.0);
  TriMesh turned = box;
  for (Eigen::Vector3i& t : turned.triangles) std::swap(t[0], t[1]);
  const Overlap overlap = CalcOverlap(JoinMeshes(box, turned, {0.03, 0.0, 0.0}));
  EXPECT_NEAR(overlap.inverted_volume, 0.03 * 0.03 * 0.02, 1e-8);
  EXPECT_NEAR(overlap.volume, -0.03 * 0.03 * 0.02, 1e-8);
}

// Two boxes that overlap by a third are the box around both: mass, centre and inertia in closed
// form.
TEST(OverlapTest, MassPropertiesCountItOnce) {
  const Eigen::Vector3d size(0.06, 0.04, 0.03), whole(0.10, 0.04, 0.03);
  const TriMesh mesh =
      JoinMeshes(MakeRoundedBox(size, 0.0), MakeRoundedBox(size, 0.0), {0.04, 0.0, 0.0});
  const MassProperties solid = CalcSolidMassProperties(mesh, 0.5, CalcOverlap(mesh));
  EXPECT_LT((solid.p_OOcm - Eigen::Vector3d(0.02, 0.0, 0.0)).norm(), 1e-5);
  const Eigen::Vector3d squares = whole.cwiseAbs2();
  const Eigen::Vector3d expected =
      0.5 / 12.0 *
      Eigen::Vector3d(squares.y() + squares.z(), squares.x() + squares.z(),
                      squares.x() + squares.y());
  EXPECT_LT((solid.I_OOcm.diagonal() - expected).norm(), 1e-3 * expected.norm());
  EXPECT_GT((CalcSolidMassProperties(mesh, 0.5).I_OOcm.diagonal() - expected).norm(),
            0.1 * expected.norm());
}

}  // namespace
}  // namespace graspbench
