#include "core/hand/import/shapes/shape_distance.h"

#include <algorithm>
#include <cmath>

#include "core/base/units.h"

namespace graspbench {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

using GeomKind = ForeignShape::Kind;

struct UnitSolid {
  double volume = 0.0;
  Vector3d moments = Vector3d::Zero();  // of unit mass, about its centre
};

/** @param half  half the extents; for shapes that are round about z, radius and half length. */
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
  // A cylinder of half length h with a hemisphere at either end.
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

namespace {

constexpr int kCellsAlong = 40;
constexpr int kCellsAcross = 8;  // at least

bool IsDisc(const CollisionShape& shape) {
  return shape.kind == CollisionShape::Kind::kCylinder && shape.size.z() < shape.size.x();
}

}  // namespace

double CalcDistance(const CollisionShape& shape, const Vector3d& p_L) {
  const Vector3d p = shape.X_LS.inverse() * p_L;
  const double radius = 0.5 * shape.size.x();
  if (shape.kind == CollisionShape::Kind::kSphere) return p.norm() - radius;
  Vector3d beyond;  // beyond the faces of a box
  if (shape.kind == CollisionShape::Kind::kBox) {
    beyond = p.cwiseAbs() - 0.5 * shape.size;
  } else if (IsDisc(shape)) {
    beyond = Vector3d(std::hypot(p.x(), p.y()) - radius, -radius,
                      std::abs(p.z()) - 0.5 * shape.size.z());
  } else {
    const double half = 0.5 * shape.size.z() - radius;
    return Vector3d(p.x(), p.y(), p.z() - std::clamp(p.z(), -half, half)).norm() - radius;
  }
  return beyond.cwiseMax(0.0).norm() + std::min(0.0, beyond.maxCoeff());
}

double CalcLinkDistance(const std::vector<CollisionShape>& shapes, int link, const Vector3d& p_L) {
  double least = 1.0;
  for (const CollisionShape& shape : shapes) {
    if (shape.link == link) least = std::min(least, CalcDistance(shape, p_L));
  }
  return least;
}

std::vector<CollisionShape> ListShapesOf(const std::vector<CollisionShape>& shapes, int link) {
  std::vector<CollisionShape> own;
  for (const CollisionShape& shape : shapes) {
    if (shape.link == link) own.push_back(shape);
  }
  return own;
}

Vector3d FindSurface(const std::vector<CollisionShape>& shapes, int link, const Vector3d& from,
                     const Vector3d& direction) {
  constexpr double kStep = 0.0002, kFarthest = 0.15;
  double leaves_at = 0.0;
  for (double s = 0.0; s < kFarthest; s += kStep) {
    if (CalcLinkDistance(shapes, link, from + s * direction) <= 0.0) leaves_at = s;
  }
  return from + leaves_at * direction;
}

Eigen::AlignedBox3d CalcBounds(const std::vector<CollisionShape>& shapes) {
  Eigen::AlignedBox3d bounds;
  for (const CollisionShape& shape : shapes) {
    const Vector3d half = 0.5 * (shape.X_LS.linear().cwiseAbs() * shape.size);
    bounds.extend(Vector3d(shape.X_LS.translation() - half));
    bounds.extend(Vector3d(shape.X_LS.translation() + half));
  }
  return bounds;
}

MassProperties CalcUnionMass(const std::vector<CollisionShape>& shapes, double density) {
  const Eigen::AlignedBox3d bounds = CalcBounds(shapes);
  const Vector3d extent = bounds.sizes();
  const double wished = extent.maxCoeff() / kCellsAlong;
  Eigen::Vector3i num;
  for (int k = 0; k < 3; ++k) {
    num[k] = std::clamp(static_cast<int>(std::ceil(extent[k] / wished)), kCellsAcross, kCellsAlong);
  }
  const Vector3d cell = extent.cwiseQuotient(num.cast<double>());
  const double cell_mass = density * cell.prod();
  MassProperties result;
  Vector3d moment = Vector3d::Zero();
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero();  // sum of m p p^T
  for (int z = 0; z < num.z(); ++z) {
    for (int y = 0; y < num.y(); ++y) {
      for (int x = 0; x < num.x(); ++x) {
        const Vector3d p = bounds.min() + cell.cwiseProduct(Vector3d(x + 0.5, y + 0.5, z + 0.5));
        double distance = CalcDistance(shapes.front(), p);
        for (const CollisionShape& shape : shapes) {
          distance = std::min(distance, CalcDistance(shape, p));
        }
        // Share of a cell that the surface cuts.
        const double share = std::clamp(0.5 - distance / cell.minCoeff(), 0.0, 1.0);
        const double mass = share * cell_mass;
        result.mass += mass;
        moment += mass * p;
        second += mass * p * p.transpose();
        second.diagonal() += mass / 12.0 * cell.cwiseAbs2();
      }
    }
  }
  result.p_OOcm = moment / result.mass;
  second -= result.mass * result.p_OOcm * result.p_OOcm.transpose();
  result.I_OOcm = second.trace() * Eigen::Matrix3d::Identity() - second;
  return result;
}

}  // namespace graspbench
