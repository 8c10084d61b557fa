#include "core/hand/import/shapes/shape_distance.h"

#include <gtest/gtest.h>

#include "core/base/units.h"

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

}  // namespace
}  // namespace graspbench
