#include "core/hand/import/shapes/geom_mass.h"

#include <cmath>

#include "core/base/units.h"

namespace graspbench {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using GeomKind = ForeignShape::Kind;

struct UnitSolid {
  double volume = 0.0;
  Vector3d moments = Vector3d::Zero();  ///< of unit mass, about its centre
};

/** @param half  of the extents; the radius and half length of what is round about z. */
UnitSolid MakeSolid(GeomKind kind, const Vector3d& half) {
  const Vector3d squares = half.cwiseAbs2();
  // sum of squares of the two other axes, times `share`
  const auto across = [&](double share) -> Vector3d {
    return share * (Vector3d::Constant(squares.sum()) - squares);
  };
  const double r2 = squares.x();
  if (kind == GeomKind::kBox) return {8.0 * half.prod(), across(1.0 / 3.0)};
  if (kind == GeomKind::kSphere || kind == GeomKind::kEllipsoid) {
    return {4.0 / 3.0 * kPi * half.prod(), across(0.2)};
  }
  if (kind == GeomKind::kCylinder) {
    const double transverse = 0.25 * r2 + squares.z() / 3.0;
    return {2.0 * kPi * r2 * half.z(), {transverse, transverse, 0.5 * r2}};
  }
  // A cylinder of half length h and a half ball at either end.
  const double radius = half.x(), h = half.z() - radius;
  const double tube = 2.0 * kPi * r2 * h, ball = 4.0 / 3.0 * kPi * r2 * radius;
  const double axial = tube * 0.5 * r2 + ball * 0.4 * r2;
  const double transverse =
      tube * (0.25 * r2 + h * h / 3.0) + ball * (0.4 * r2 + 0.75 * h * radius + h * h);
  return {tube + ball, Vector3d(transverse, transverse, axial) / (tube + ball)};
}

}  // namespace

MassProperties CalcGeomMass(const ForeignShape& shape, const TriMesh& mesh) {
  const ForeignShape::Weight& weight = *shape.weight;
  MassProperties result;
  if (shape.kind == GeomKind::kMesh) {
    const double volume = CalcVolume(mesh);
    const double mass = weight.mass.value_or(weight.density * volume);
    return volume > 0.0 && mass > 0.0 ? CalcSolidMassProperties(mesh, mass) : result;
  }
  const UnitSolid solid = MakeSolid(shape.kind, 0.5 * shape.size);
  const Matrix3d& R = shape.X_LS.linear();
  result.mass = weight.mass.value_or(weight.density * solid.volume);
  result.p_OOcm = shape.X_LS.translation();
  result.I_OOcm = result.mass * (R * solid.moments.asDiagonal() * R.transpose());
  return result;
}

MassProperties AddMass(const MassProperties& a, const MassProperties& b) {
  if (b.mass == 0.0) return a;
  if (a.mass == 0.0) return b;
  MassProperties sum;
  sum.mass = a.mass + b.mass;
  sum.p_OOcm = (a.mass * a.p_OOcm + b.mass * b.p_OOcm) / sum.mass;
  const Vector3d apart = b.p_OOcm - a.p_OOcm;
  const double reduced = a.mass * b.mass / sum.mass;
  sum.I_OOcm = a.I_OOcm + b.I_OOcm +
               reduced * (apart.squaredNorm() * Matrix3d::Identity() - apart * apart.transpose());
  return sum;
}

}  // namespace graspbench
