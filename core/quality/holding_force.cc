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
/** What carrying the whole weight is worth to the program, in sums of normal forces: more than any
pull can gain by carrying less. */
constexpr double kWeightValue = 1e3;

}  // namespace

std::vector<double> CalcHoldingForces(const LoadedGrasp& grasp,
                                      const std::vector<Vector3d>& directions) {
  std::vector<double> holding(directions.size(), 0.0);
  if (grasp.contacts.empty()) return holding;
  WrenchSpace space;
  space.num_edges = kNumEdges;
  space.torque_scale = grasp.radius;
  const ConeWrenches cones = CalcConeWrenches(grasp.contacts, space);
  const Eigen::Index num_cones = cones.wrenches.cols();

  std::vector<int> digits = grasp.digits;
  std::sort(digits.begin(), digits.end());
  digits.erase(std::unique(digits.begin(), digits.end()), digits.end());
  const auto num_digits = static_cast<Eigen::Index>(digits.size());

  // Forces in units of the sum of normal forces, so that all numbers of the program are of one
  // size. Variables: the weights of the generators, and the share of the object's weight that is
  // carried. Rows: balance across the pull (2, both ways), moments (3, both ways), digits, that
  // share.
  MatrixXd A = MatrixXd::Zero(10 + num_digits + 1, num_cones + 1);
  VectorXd b = VectorXd::Zero(A.rows());
  const auto row_of_digit = [&](int digit) {
    return 10 + (std::lower_bound(digits.begin(), digits.end(), digit) - digits.begin());
  };
  const double normal_force =
      std::accumulate(grasp.normal_forces.begin(), grasp.normal_forces.end(), 0.0);
  const Vector3d weight = grasp.weight / normal_force;
  for (size_t i = 0; i < grasp.contacts.size(); ++i) {
    b[row_of_digit(grasp.digits[i])] += grasp.normal_forces[i] / normal_force;
  }
  for (Eigen::Index j = 0; j < num_cones; ++j) {
    A(row_of_digit(grasp.digits[cones.contact_indices[j]]), j) = 1.0;
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
    const LinearProgramResult result = SolveLinearProgram(A, b, c);
    if (result.end != LinearProgramEnd::kOptimum) {
      throw Error(ErrorKind::kRange,
                  fmt::format("the force that {} contacts hold is lost to rounding: their places, "
                              "normals or friction are too far apart",
                              grasp.contacts.size()));
    }
    const double gain = result.value - kWeightValue;
    holding[k] = normal_force * std::max(0.0, gain);
  }
  return holding;
}

}  // namespace graspbench
