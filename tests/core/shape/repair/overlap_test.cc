#include "core/shape/repair/overlap.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/units.h"
#include "core/shape/mass_properties.h"
#include "core/shape/primitives.h"
#include "tests/core/shape/join_meshes.h"

namespace graspbench {
namespace {

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
