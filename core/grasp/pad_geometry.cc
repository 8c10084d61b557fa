#include "core/grasp/pad_geometry.h"

#include <Eigen/Dense>
#include <cmath>

#include "core/base/error.h"
#include "core/base/units.h"

namespace graspbench {

using Eigen::Matrix3d;
using Eigen::Matrix3Xd;
using Eigen::Vector3d;

double CalcPlaneResidual(const Matrix3Xd& pads) {
  if (pads.cols() < 4) return kUnset;
  const Matrix3Xd from_mean = pads.colwise() - pads.rowwise().mean();
  const Matrix3d scatter = from_mean * from_mean.transpose();
  if (!scatter.allFinite()) return kUnset;
  const Eigen::SelfAdjointEigenSolver<Matrix3d> solver(scatter, Eigen::EigenvaluesOnly);
  const double least = std::fmax(solver.eigenvalues()[0], 0.0);
  return std::sqrt(least / static_cast<double>(pads.cols()));
}

double CalcMeetingResidual(const Matrix3Xd& pads, const Matrix3Xd& directions) {
  GRASPBENCH_DEMAND(pads.cols() == directions.cols(), std::to_string(directions.cols()));
  if (pads.cols() < 2) return kUnset;
  const Vector3d mean = pads.rowwise().mean();
  Matrix3d across_all = Matrix3d::Zero();
  Vector3d offset = Vector3d::Zero();
  for (Eigen::Index i = 0; i < pads.cols(); ++i) {
    const Vector3d u = directions.col(i).normalized();
    const Matrix3d across = Matrix3d::Identity() - u * u.transpose();
    across_all += across;
    offset += across * (pads.col(i) - mean);
  }
  if (!across_all.allFinite() || !offset.allFinite()) return kUnset;
  if (directions.colwise().squaredNorm().minCoeff() <= 0.0) return kUnset;
  // The nearest points of parallel lines form a line; the one nearest to the mean is chosen.
  const Vector3d from_mean = across_all.completeOrthogonalDecomposition().solve(offset);
  double sum = 0.0;
  for (Eigen::Index i = 0; i < pads.cols(); ++i) {
    const Vector3d way = from_mean - (pads.col(i) - mean);
    sum += way.squaredNorm() - std::pow(way.dot(directions.col(i).normalized()), 2);
  }
  return std::sqrt(std::fmax(sum, 0.0) / static_cast<double>(pads.cols()));
}

}  // namespace graspbench
