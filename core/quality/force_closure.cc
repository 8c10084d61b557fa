#include "core/quality/force_closure.h"

#include <Eigen/QR>
#include <Eigen/SVD>
#include <cmath>
#include <limits>
#include <string>

#include "core/base/error.h"
#include "core/quality/affine_basis.h"
#include "core/quality/epsilon_fast.h"
#include "core/quality/linear_program.h"

namespace graspbench {

bool IsForceClosure(const Eigen::MatrixXd& wrenches) {
  return CalcEpsilonBounds(wrenches).lower > 0.0;
}

double CalcMinSingularValue(const WrenchMatrix& grasp_matrix) {
  if (grasp_matrix.cols() < 6) return 0.0;
  // The values of R in G' = Q R are those of G. Eigen's SVD of a matrix of any size would do this
  // step itself, and takes six seconds to compile.
  using Matrix6 = Eigen::Matrix<double, 6, 6>;
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(grasp_matrix.transpose());
  const Matrix6 R = qr.matrixR().topRows<6>().triangularView<Eigen::Upper>();
  const Eigen::Matrix<double, 6, 1> values =
      Eigen::JacobiSVD<Matrix6, Eigen::NoQRPreconditioner>(R).singularValues();
  return values[5] > kNegligibleShare * values[0] ? values[5] : 0.0;
}

double CalcTaskForce(const ConeWrenches& cones, const Eigen::Matrix<double, 6, 1>& direction,
                     ForceLimit limit) {
  GRASPBENCH_DEMAND(std::abs(direction.norm() - 1.0) < 1e-9,
                    "length: " + std::to_string(direction.norm()));
  if (cones.contact_indices.empty()) return 0.0;
  const Eigen::Index num_generators = cones.wrenches.cols();
  const int num_limits = limit == ForceLimit::kSum ? 1 : cones.contact_indices.back() + 1;
  // Variables: the weights, then s. Rows: W lambda - s d <= 0, the same >= 0, the limits, and a
  // bound on s that it cannot reach, so that rounding never looks like a way to infinity. Dividing
  // by the largest wrench makes all entries at most one, so |W lambda| <= sqrt(6) num_limits.
  const double scale = cones.wrenches.cwiseAbs().maxCoeff();
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(13 + num_limits, num_generators + 1);
  A.topLeftCorner(6, num_generators) = cones.wrenches / scale;
  A.block<6, 1>(0, num_generators) = -direction;
  A.middleRows<6>(6) = -A.topRows<6>();
  for (Eigen::Index j = 0; j < num_generators; ++j) {
    A(12 + (limit == ForceLimit::kSum ? 0 : cones.contact_indices[j]), j) = 1.0;
  }
  A(12 + num_limits, num_generators) = 1.0;
  const double unreachable = 3.0 * num_limits;
  Eigen::VectorXd b = Eigen::VectorXd::Zero(13 + num_limits);
  b.segment(12, num_limits).setOnes();
  b[12 + num_limits] = unreachable;
  const Eigen::VectorXd c = Eigen::VectorXd::Unit(num_generators + 1, num_generators);
  const LinearProgramResult result = SolveLinearProgram(A, b, c);
  // The program is bounded by its last row: what looks otherwise is rounding.
  if (result.end != LinearProgramEnd::kOptimum || result.value > 0.9 * unreachable) {
    return std::numeric_limits<double>::quiet_NaN();
  }
  return result.value * scale;
}

}  // namespace graspbench
