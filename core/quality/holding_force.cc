#include "core/quality/holding_force.h"

#include <fmt/core.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <numeric>

#include "core/base/error.h"
#include "core/quality/linear_program.h"

namespace graspbench {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr int kNumEdges = 8;
constexpr double kMomentShare = 0.03;
/** What carrying the whole weight is worth to a program, in its unit of force: more than any pull
can gain by carrying less, and more than any force costs. A grasp that would need more cannot bear
it for any practical purpose. */
constexpr double kWeightValue = 1e3;
/** Of all normal force beside F, so that free digits press no harder than they must. */
constexpr double kFreeCost = 1e-3;
constexpr double kCarried = 1.0 - 1e-6;

ConeWrenches CalcCones(const LoadedGrasp& grasp) {
  WrenchSpace space;
  space.num_edges = kNumEdges;
  space.torque_scale = grasp.radius;
  return CalcConeWrenches(grasp.contacts, space);
}

/** One row of a program for each digit. */
class DigitRows {
 public:
  DigitRows(Eigen::Index first, std::vector<int> digits)
      : first_(first), digits_(std::move(digits)) {
    std::sort(digits_.begin(), digits_.end());
    digits_.erase(std::unique(digits_.begin(), digits_.end()), digits_.end());
  }
  Eigen::Index end() const { return first_ + static_cast<Eigen::Index>(digits_.size()); }
  Eigen::Index operator[](int digit) const {
    return first_ + (std::lower_bound(digits_.begin(), digits_.end(), digit) - digits_.begin());
  }

 private:
  Eigen::Index first_;
  std::vector<int> digits_;
};

/** @param what  is lost if the program cannot be solved, for the message; {}: the contacts. */
LinearProgramResult Solve(const MatrixXd& A, const VectorXd& b, const VectorXd& c,
                          fmt::format_string<size_t> what, const LoadedGrasp& grasp) {
  LinearProgramResult result = SolveLinearProgram(A, b, c);
  if (result.end == LinearProgramEnd::kOptimum) return result;
  throw Error(ErrorKind::kRange, fmt::format(what, grasp.contacts.size()) +
                                     " is lost to rounding: their places, normals or friction are "
                                     "too far apart");
}

}  // namespace

std::vector<double> CalcHoldingForces(const LoadedGrasp& grasp,
                                      const std::vector<Vector3d>& directions) {
  std::vector<double> holding(directions.size(), 0.0);
  if (grasp.contacts.empty()) return holding;
  const ConeWrenches cones = CalcCones(grasp);
  const Eigen::Index num_cones = cones.wrenches.cols();

  const DigitRows row_of_digit(10, grasp.digits);
  // Forces in units of the sum of normal forces, so that all numbers of the program are of one
  // size. Variables: the weights of the generators, and the share of the object's weight that is
  // carried. Rows: balance across the pull (2, both ways), moments (3, both ways), digits, that
  // share.
  MatrixXd A = MatrixXd::Zero(row_of_digit.end() + 1, num_cones + 1);
  VectorXd b = VectorXd::Zero(A.rows());
  const double normal_force =
      std::accumulate(grasp.normal_forces.begin(), grasp.normal_forces.end(), 0.0);
  const Vector3d weight = grasp.weight / normal_force;
  for (size_t i = 0; i < grasp.contacts.size(); ++i) {
    b[row_of_digit[grasp.digits[i]]] += grasp.normal_forces[i] / normal_force;
  }
  for (Eigen::Index j = 0; j < num_cones; ++j) {
    A(row_of_digit[grasp.digits[cones.contact_indices[j]]], j) = 1.0;
  }
  A.block(4, 0, 3, num_cones) = cones.wrenches.bottomRows<3>();
  A.block(7, 0, 3, num_cones) = -cones.wrenches.bottomRows<3>();
  b.segment(4, 6).setConstant(kMomentShare);
  A(A.rows() - 1, num_cones) = 1.0;
  b[A.rows() - 1] = 1.0;

  VectorXd c(num_cones + 1);
  for (size_t k = 0; k < directions.size(); ++k) {
    const Vector3d& d = directions[k];
    const Vector3d t1 = d.unitOrthogonal(), t2 = d.cross(t1);
    A.row(0).head(num_cones) = t1.transpose() * cones.wrenches.topRows<3>();
    A.row(1).head(num_cones) = t2.transpose() * cones.wrenches.topRows<3>();
    A(0, num_cones) = t1.dot(weight);
    A(1, num_cones) = t2.dot(weight);
    A.middleRows(2, 2) = -A.topRows(2);
    c.head(num_cones) = -(d.transpose() * cones.wrenches.topRows<3>()).transpose();
    c[num_cones] = kWeightValue - d.dot(weight);
    // Continuous in all that goes in, also where the weight can just no longer be carried.
    const LinearProgramResult result = Solve(A, b, c, "the force that {} contacts hold", grasp);
    const double gain = result.value - kWeightValue;
    holding[k] = normal_force * std::max(0.0, gain);
  }
  return holding;
}

std::optional<double> CalcSmallestGrip(const LoadedGrasp& grasp, const std::vector<bool>& is_free) {
  const double weight = grasp.weight.norm();
  if (weight == 0.0) return 0.0;
  if (grasp.contacts.empty()) return std::nullopt;
  const ConeWrenches cones = CalcCones(grasp);
  const Eigen::Index n = cones.wrenches.cols();

  std::vector<int> digits;
  for (size_t i = 0; i < grasp.contacts.size(); ++i) {
    if (!is_free[i]) digits.push_back(grasp.digits[i]);
  }
  const DigitRows row_of_digit(12, std::move(digits));

  // Variables: weights of the generators in units of the object's weight, the share of it that is
  // carried, F. Rows: forces (3, both ways), moments (3, both ways), digits, the share.
  MatrixXd A = MatrixXd::Zero(row_of_digit.end() + 1, n + 2);
  VectorXd b = VectorXd::Zero(A.rows());
  A.topLeftCorner(3, n) = cones.wrenches.topRows<3>();
  A.block(0, n, 3, 1) = grasp.weight / weight;
  A.middleRows(3, 3) = -A.topRows(3);
  A.block(6, 0, 3, n) = cones.wrenches.bottomRows<3>().array() - kMomentShare;
  A.block(9, 0, 3, n) = -cones.wrenches.bottomRows<3>().array() - kMomentShare;
  for (Eigen::Index j = 0; j < n; ++j) {
    const auto contact = static_cast<size_t>(cones.contact_indices[static_cast<size_t>(j)]);
    if (is_free[contact]) continue;
    const Eigen::Index row = row_of_digit[grasp.digits[contact]];
    A(row, j) = 1.0;
    A(row, n + 1) = -1.0;
  }
  A(A.rows() - 1, n) = 1.0;
  b[A.rows() - 1] = 1.0;
  VectorXd c = VectorXd::Constant(n + 2, -kFreeCost);
  c[n] = kWeightValue;
  c[n + 1] = -1.0;
  const LinearProgramResult result = Solve(A, b, c, "the smallest grip of {} contacts", grasp);
  if (result.x[n] < kCarried) return std::nullopt;
  return weight * result.x[n + 1];
}

}  // namespace graspbench
