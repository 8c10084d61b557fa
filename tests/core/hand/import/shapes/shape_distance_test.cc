#include "core/hand/import/shapes/shape_distance.h"

#include <gtest/gtest.h>

#include "core/base/units.h"
#include "core/shape/primitives.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;
using SolidKind = CollisionShape::Kind;

CollisionShape Shape(SolidKind kind, const Vector3d& size,
                     const Vector3d& place = Vector3d::Zero()) {
  CollisionShape shape;
  shape.kind = kind;
  shape.size = size;
  shape.X_LS.translation() = place;
  return shape;
}

TEST(ShapeDistanceTest, KnowsItsClosedForms) {
  const CollisionShape ball = Shape(SolidKind::kSphere, Vector3d::Constant(0.02), {0.1, 0, 0});
  EXPECT_NEAR(CalcDistance(ball, {0.1, 0, 0.03}), 0.02, 1e-15);
  EXPECT_NEAR(CalcDistance(ball, {0.1, 0, 0}), -0.01, 1e-15);
  const CollisionShape box = Shape(SolidKind::kBox, {0.02, 0.04, 0.06});
  EXPECT_NEAR(CalcDistance(box, {0.013, 0.024, 0}), 0.005, 1e-15);
  EXPECT_NEAR(CalcDistance(box, {0.008, 0, 0}), -0.002, 1e-15);
  const CollisionShape capsule = Shape(SolidKind::kCylinder, {0.02, 0.02, 0.06});
  EXPECT_NEAR(CalcDistance(capsule, {0, 0, 0.035}), 0.005, 1e-15);
  EXPECT_NEAR(CalcDistance(capsule, {0.013, 0, 0.01}), 0.003, 1e-15);
  const CollisionShape disc = Shape(SolidKind::kCylinder, {0.06, 0.06, 0.02});
  EXPECT_NEAR(CalcDistance(disc, {0.029, 0, 0.012}), 0.002, 1e-15);
}

TEST(ShapeDistanceTest, MassOfABox) {
  const Vector3d size(0.02, 0.03, 0.05), place(0.01, -0.02, 0.03);
  const MassProperties mass = CalcUnionMass({Shape(SolidKind::kBox, size, place)}, 1000.0);
  EXPECT_NEAR(mass.mass, 1000.0 * size.prod(), 0.02 * 1000.0 * size.prod());
  EXPECT_LT((mass.p_OOcm - place).norm(), 1e-6);
  const double Ixx = mass.mass / 12.0 * (size.y() * size.y() + size.z() * size.z());
  EXPECT_NEAR(mass.I_OOcm(0, 0), Ixx, 0.03 * Ixx);
}

TEST(ShapeDistanceTest, OverlapCountsOnce) {
  const CollisionShape ball = Shape(SolidKind::kSphere, Vector3d::Constant(0.03));
  const MassProperties one = CalcUnionMass({ball}, 1000.0);
  EXPECT_EQ(CalcUnionMass({ball, ball, ball}, 1000.0).mass, one.mass);
  const double exact = 1000.0 * kPi / 6.0 * 0.03 * 0.03 * 0.03;
  EXPECT_NEAR(one.mass, exact, 0.01 * exact);
  EXPECT_NEAR(one.I_OOcm(2, 2), 0.4 * one.mass * 0.015 * 0.015, 0.02 * one.I_OOcm(2, 2));
}

using Kind = ForeignShape::Kind;

ForeignShape MakeShape(Kind kind, const Vector3d& size) {
  ForeignShape shape;
  shape.kind = kind;
  shape.size = size;
  shape.weight = ForeignShape::Weight{{}, 1000.0};
  return shape;
}

/** The same solid as a fine mesh of the same mass. */
MassProperties WeighMesh(const TriMesh& mesh, double mass) {
  ForeignShape shape = MakeShape(Kind::kMesh, Vector3d::Zero());
  shape.weight->mass = mass;
  return CalcGeomMass(shape, mesh);
}

void ExpectNear(const MassProperties& a, const MassProperties& b, double relative) {
  EXPECT_NEAR(a.mass, b.mass, relative * b.mass);
  EXPECT_LT((a.p_OOcm - b.p_OOcm).norm(), relative);
  EXPECT_LT((a.I_OOcm - b.I_OOcm).norm(), relative * b.I_OOcm.norm());
}

TEST(GeomMassTest, VolumesInClosedForm) {
  const auto weigh = [](Kind kind, const Vector3d& size) {
    return CalcGeomMass(MakeShape(kind, size), {}).mass;
  };
  EXPECT_NEAR(weigh(Kind::kBox, {0.1, 0.2, 0.3}), 6.0, 1e-12);
  EXPECT_NEAR(weigh(Kind::kSphere, {0.2, 0.2, 0.2}), 4.0 / 3.0 * kPi, 1e-12);
  EXPECT_NEAR(weigh(Kind::kEllipsoid, {0.2, 0.4, 0.6}), 8.0 * kPi, 1e-12);
  EXPECT_NEAR(weigh(Kind::kCylinder, {0.2, 0.2, 0.5}), 5.0 * kPi, 1e-12);
  EXPECT_NEAR(weigh(Kind::kCapsule, {0.2, 0.2, 0.5}), (3.0 + 4.0 / 3.0) * kPi, 1e-12);
}

// Against the divergence theorem on meshes of the same solids.
TEST(GeomMassTest, InertiasAreThoseOfMeshes) {
  const Vector3d half(0.01, 0.02, 0.03);
  TriMesh ellipsoid = MakeSphere(1.0, 96);
  for (Vector3d& p : ellipsoid.vertices) p = p.cwiseProduct(half);
  const MassProperties of_ellipsoid = CalcGeomMass(MakeShape(Kind::kEllipsoid, 2.0 * half), {});
  ExpectNear(WeighMesh(ellipsoid, of_ellipsoid.mass), of_ellipsoid, 0.003);

  const TriMesh rod = MakeRevolution({{0.0, -0.03}, {0.01, -0.03}, {0.01, 0.03}, {0.0, 0.03}}, 192);
  const MassProperties of_rod = CalcGeomMass(MakeShape(Kind::kCylinder, {0.02, 0.02, 0.06}), {});
  ExpectNear(WeighMesh(rod, of_rod.mass), of_rod, 0.003);

  const TriMesh capsule =
      MakeTaperedCapsule(Vector3d(0, 0, -0.02), 0.01, Vector3d(0, 0, 0.02), 0.01, 96);
  const MassProperties of_capsule = CalcGeomMass(MakeShape(Kind::kCapsule, {0.02, 0.02, 0.06}), {});
  ExpectNear(WeighMesh(capsule, of_capsule.mass), of_capsule, 0.003);
}

// Two halves of a box are the box, wherever the cut and however they are turned.
TEST(GeomMassTest, HalvesMakeTheWhole) {
  const ForeignShape whole = MakeShape(Kind::kBox, {0.04, 0.06, 0.08});
  ForeignShape low = MakeShape(Kind::kBox, {0.04, 0.08, 0.02});  // turned about x
  low.X_LS = MakePose(MakeRotationRpy(0.5 * kPi, 0, 0), {0, -0.02, 0});
  ForeignShape high = MakeShape(Kind::kBox, {0.04, 0.04, 0.08});
  high.X_LS = MakePose(Vector3d(0, 0.01, 0));
  ExpectNear(AddMass(CalcGeomMass(low, {}), CalcGeomMass(high, {})), CalcGeomMass(whole, {}),
             1e-12);
}

TEST(GeomMassTest, AGivenMassCounts) {
  ForeignShape shape = MakeShape(Kind::kBox, {0.1, 0.1, 0.1});
  shape.weight->mass = 0.12;
  const MassProperties mass = CalcGeomMass(shape, {});
  EXPECT_EQ(mass.mass, 0.12);
  EXPECT_NEAR(mass.I_OOcm(0, 0), 0.12 * 0.02 / 12.0, 1e-15);
}

// An open mesh, or one inside out, has no volume to trust.
TEST(GeomMassTest, AMeshWithoutVolumeWeighsNothing) {
  TriMesh mesh = MakeSphere(0.01, 16);
  for (Eigen::Vector3i& triangle : mesh.triangles) std::swap(triangle[1], triangle[2]);
  EXPECT_EQ(CalcGeomMass(MakeShape(Kind::kMesh, Vector3d::Zero()), mesh).mass, 0.0);
}

}  // namespace
}  // namespace graspbench
