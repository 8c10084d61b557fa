#include "core/shape/resting_pose.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/base/random.h"
#include "core/base/units.h"
#include "core/shape/mass_properties.h"
#include "core/shape/primitives.h"

namespace graspbench {
namespace {

using Eigen::AngleAxisd;
using Eigen::Matrix3d;
using Eigen::Vector3d;

TriMesh Turn(TriMesh mesh, double angle, const Vector3d& axis) {
  const Matrix3d R = AngleAxisd(angle, axis.normalized()).toRotationMatrix();
  for (Vector3d& p : mesh.vertices) p = R * p;
  return mesh;
}

Vector3d CalcCentre(const TriMesh& mesh) { return CalcSolidMassProperties(mesh, 1.0).p_OOcm; }

double CalcHeightOfCentre(const TriMesh& mesh, const Vector3d& p_OOcm, const Matrix3d& R) {
  double lowest = 1e9;
  for (const Vector3d& p : mesh.vertices) lowest = std::min(lowest, (R * p).z());
  return (R * p_OOcm).z() - lowest;
}

const TriMesh kBrick = MakeRoundedBox(Vector3d(0.08, 0.06, 0.02), 0.0);

TEST(RestingRotationTest, WhatRestsStaysAsItIsToTheBit) {
  EXPECT_EQ(FindRestingRotation(kBrick, Vector3d::Zero()), Matrix3d::Identity());
  EXPECT_EQ(FindRestingRotation(kBrick, Vector3d(0.039, -0.029, 0.005)), Matrix3d::Identity());
}

// A brick on an edge falls back while its centre is on that side of the edge: below atan(20/80).
TEST(RestingRotationTest, ATiltedBrickFallsToTheSideOfItsCentre) {
  const double critical = std::atan(80.0 / 20.0);
  for (const double tilt : {0.001, 0.3, 0.99 * critical, 1.01 * critical, 1.5}) {
    const TriMesh mesh = Turn(kBrick, tilt, Vector3d::UnitY());
    const Matrix3d R = FindRestingRotation(mesh, Vector3d::Zero());
    const double turn = tilt < critical ? -tilt : 0.5 * kPi - tilt;
    EXPECT_TRUE(R.isApprox(AngleAxisd(turn, Vector3d::UnitY()).toRotationMatrix(), 1e-9)) << tilt;
  }
}

// Loaded 1 mm beside its base it tips by a quarter turn, 1 mm inside it does not.
TEST(RestingRotationTest, ACentreBesideTheBaseTipsIt) {
  const TriMesh leaning =
      MakeLoft({{{0, 0, 0}, {0.03, 0, 0}, {0.03, 0.03, 0}, {0, 0.03, 0}},
                {{0.06, 0, 0.05}, {0.09, 0, 0.05}, {0.09, 0.03, 0.05}, {0.06, 0.03, 0.05}}});
  EXPECT_EQ(FindRestingRotation(leaning, Vector3d(0.029, 0.015, 0.02)), Matrix3d::Identity());
  // Onto the overhanging face, which leans by atan(50 / 60) over the table.
  const Matrix3d R = FindRestingRotation(leaning, Vector3d(0.031, 0.015, 0.02));
  EXPECT_NEAR(AngleAxisd(R).angle(), std::atan2(0.05, 0.06), 1e-9);
  EXPECT_NEAR(std::abs(AngleAxisd(R).axis().y()), 1.0, 1e-9);
}

// Balanced on an edge nothing holds it there.
TEST(RestingRotationTest, APoisedCubeFalls) {
  const TriMesh cube = MakeRoundedBox(Vector3d::Constant(0.04), 0.0);
  const TriMesh poised = Turn(cube, 0.25 * kPi, Vector3d::UnitX());
  const Matrix3d R = FindRestingRotation(poised, Vector3d::Zero());
  EXPECT_NEAR(AngleAxisd(R).angle(), 0.25 * kPi, 1e-9);
}

// Brute force: wherever a lump of random corners comes to rest, no small turn lowers its centre, and
// the centre is not higher than when it was set down.
TEST(RestingRotationTest, RestsWhereNoTurnLowersTheCentre) {
  RandomStream stream("resting", "lumps");
  int num_turned = 0;
  for (int lump = 0; lump < 40; ++lump) {
    TriMesh mesh = MakeSphere(0.03, 16);
    for (Vector3d& p : mesh.vertices) {
      p *= stream.NextUniform(0.9, 1.1);
      p.z() *= 0.7;
    }
    const Vector3d centre = CalcCentre(mesh);
    const Matrix3d R = FindRestingRotation(mesh, centre);
    num_turned += !R.isIdentity(0.0);
    const double height = CalcHeightOfCentre(mesh, centre, R);
    EXPECT_LE(height, CalcHeightOfCentre(mesh, centre, Matrix3d::Identity()) + 1e-9);
    for (int k = 0; k < 36; ++k) {
      const Vector3d axis(std::cos(k * kPi / 18), std::sin(k * kPi / 18), 0.0);
      const Matrix3d turned = AngleAxisd(1e-4, axis).toRotationMatrix() * R;
      EXPECT_GE(CalcHeightOfCentre(mesh, centre, turned), height - 1e-7) << lump << " " << k;
    }
  }
  EXPECT_GT(num_turned, 30);
}

TEST(LayDownTest, KeepsTheBodyAndFillsItsNewBox) {
  GraspObject object;
  object.mesh = Turn(kBrick, 1.5, Vector3d::UnitY());
  object.size = Vector3d::Constant(0.1);
  object.compressible = {0.7, Vector3d(0.001, 0.002, 0.003).asDiagonal(), false};
  object.mass_properties = CalcSolidMassProperties(object.mesh, 0.3);
  LayDown(object);
  EXPECT_NEAR(object.turned_to_rest, 0.5 * kPi - 1.5, 1e-9);
  EXPECT_TRUE(object.size.isApprox(Vector3d(0.02, 0.06, 0.08), 1e-9));
  const MassProperties expected = CalcSolidMassProperties(object.mesh, 0.3);
  EXPECT_TRUE(object.mass_properties.p_OOcm.isApprox(expected.p_OOcm, 1e-9) ||
              object.mass_properties.p_OOcm.norm() < 1e-12);
  EXPECT_TRUE(object.mass_properties.I_OOcm.isApprox(expected.I_OOcm, 1e-9));
  const double turned = std::sin(object.turned_to_rest) * std::sin(object.turned_to_rest);
  const Matrix3d& yield = object.compressible->yield;
  EXPECT_NEAR(yield(0, 0), 0.001 * (1.0 - turned) + 0.003 * turned, 1e-12);
  EXPECT_NEAR(yield(1, 1), 0.002, 1e-12);
}

}  // namespace
}  // namespace graspbench
