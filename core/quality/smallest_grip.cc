#include "core/quality/smallest_grip.h"

#include <fmt/core.h>

#include <algorithm>

#include "core/base/error.h"
#include "core/quality/linear_program.h"

namespace graspbench {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kNumEdges = 8;
constexpr double kMomentShare = 0.03;
/** What carrying the whole weight is worth to the program, in weights: more than any force costs. A
grasp that would need more cannot bear it for any practical purpose. */
constexpr double kWeightValue = 1e3;
/** Of all normal force beside F, so that free digits press no harder than they must. */
constexpr double kFreeCost = 1e-3;
constexpr double kCarried = 1.0 - 1e-6;

}  // namespace

std::optional<double> CalcSmallestGrip(const LoadedGrasp& grasp, const std::vector<bool>& is_free) {
  const double weight = grasp.weight.norm();
  if (weight == 0.0) return 0.0;
  if (grasp.contacts.empty()) return std::nullopt;
  WrenchSpace space;
  space.num_edges = kNumEdges;
  space.torque_scale = grasp.radius;
  const ConeWrenches cones = CalcConeWrenches(grasp.contacts, space);
  const Eigen::Index n = cones.wrenches.cols();

  std::vector<int> digits;
  for (size_t i = 0; i < grasp.contacts.size(); ++i) {
    if (!is_free[i]) digits.push_back(grasp.digits[i]);
  }
  std::sort(digits.begin(), digits.end());
  digits.erase(std::unique(digits.begin(), digits.end()), digits.end());

  // Variables: weights of the generators in units of the object's weight, the share of it that is
  // carried, F. Rows: forces (3, both ways), moments (3, both ways), digits, the share.
  MatrixXd A = MatrixXd::Zero(12 + static_cast<Eigen::Index>(digits.size()) + 1, n + 2);
  VectorXd b = VectorXd::Zero(A.rows());
  A.topLeftCorner(3, n) = cones.wrenches.topRows<3>();
  A.block(0, n, 3, 1) = grasp.weight / weight;
  A.middleRows(3, 3) = -A.topRows(3);
  A.block(6, 0, 3, n) = cones.wrenches.bottomRows<3>().array() - kMomentShare;
  A.block(9, 0, 3, n) = -cones.wrenches.bottomRows<3>().array() - kMomentShare;
  for (Eigen::Index j = 0; j < n; ++j) {
    const auto contact = static_cast<size_t>(cones.contact_indices[static_cast<size_t>(j)]);
    if (is_free[contact]) continue;
    const auto row = 12 + (std::lower_bound(digits.begin(), digits.end(), grasp.digits[contact]) -
                           digits.begin());
    A(row, j) = 1.0;
    A(row, n + 1) = -1.0;
  }
  A(A.rows() - 1, n) = 1.0;
  b[A.rows() - 1] = 1.0;
  VectorXd c = VectorXd::Constant(n + 2, -kFreeCost);
  c[n] = kWeightValue;
  c[n + 1] = -1.0;
  const LinearProgramResult result = SolveLinearProgram(A, b, c);
  if (result.end != LinearProgramEnd::kOptimum) {
    throw Error(ErrorKind::kRange,
                fmt::format("the smallest grip of {} contacts is lost to rounding: their places, "
                            "normals or friction are too far apart",
                            grasp.contacts.size()));
  }
  if (result.x[n] < kCarried) return std::nullopt;
  return weight * result.x[n + 1];
}

}  // namespace graspbench
