#include "core/quality/linear_program.h"

#include <cmath>
#include <string>
#include <vector>

#include "core/base/error.h"

namespace graspbench {
namespace {

constexpr double kZero = 1e-11;            // smaller gains are rounding
constexpr double kSmallestPivot = 1e-9;    // smaller ones would blow rounding up
constexpr double kTie = 1e-12;             // ratios that differ by less are equal but for rounding
constexpr Eigen::Index kStableSteps = 20;  // per row and column, before Bland's rule
constexpr double kRoundingGain = 1e-7;     // relative to the largest objective coefficient

}  // namespace

LinearProgramResult SolveLinearProgram(const Eigen::MatrixXd& A, const Eigen::VectorXd& b,
                                       const Eigen::VectorXd& c) {
  const Eigen::Index num_rows = A.rows(), num_variables = A.cols();
  GRASPBENCH_DEMAND(b.size() == num_rows && c.size() == num_variables,
                    "sizes: " + std::to_string(b.size()) + ", " + std::to_string(c.size()));
  GRASPBENCH_DEMAND(num_rows == 0 || b.minCoeff() >= 0.0, "a negative bound");

  // Columns: variables, slacks, right-hand side. The last row holds minus the gains.
  const Eigen::Index num_columns = num_variables + num_rows;
  Eigen::MatrixXd tableau = Eigen::MatrixXd::Zero(num_rows + 1, num_columns + 1);
  tableau.topLeftCorner(num_rows, num_variables) = A;
  tableau.block(0, num_variables, num_rows, num_rows).setIdentity();
  tableau.col(num_columns).head(num_rows) = b;
  tableau.row(num_rows).head(num_variables) = -c.transpose();
  std::vector<Eigen::Index> basis(num_rows);  // the variable each row stands for
  for (Eigen::Index row = 0; row < num_rows; ++row) basis[row] = num_variables + row;

  const double rounding_gain = num_variables > 0 ? kRoundingGain * c.cwiseAbs().maxCoeff() : 0.0;
  LinearProgramResult result;
  const Eigen::Index num_stable_steps = kStableSteps * (num_rows + num_columns);
  for (Eigen::Index step = 0;; ++step) {
    if (step > 4 * num_stable_steps) {  // Bland's rule cannot cycle, but for rounding
      throw Error(ErrorKind::kRange, "a linear program of " + std::to_string(num_rows) +
                                         " rows had not ended after " + std::to_string(step) +
                                         " steps: its numbers are too far apart");
    }
    // The first variable that gains enters. Of the tightest rows the one with the largest pivot
    // leaves, which keeps rounding small; should that go on for too long, it might cycle, and the
    // one with the first variable leaves instead (Bland's rule). A tiny gain that no row limits is
    // rounding, not a way to infinity.
    const bool is_stable = step < num_stable_steps;
    Eigen::Index enter = -1, leave = -1;
    for (Eigen::Index column = 0; column < num_columns && leave < 0; ++column) {
      const double gain = -tableau(num_rows, column);
      if (gain <= kZero) continue;
      enter = column;
      double tightest = 0.0;
      for (Eigen::Index row = 0; row < num_rows; ++row) {
        if (tableau(row, enter) <= kSmallestPivot) continue;
        const double ratio = tableau(row, num_columns) / tableau(row, enter);
        const bool is_tie = leave >= 0 && std::abs(ratio - tightest) <= kTie;
        const bool wins_tie =
            is_tie && (is_stable ? tableau(row, enter) > tableau(leave, enter)
                                 : ratio == tightest && basis[row] < basis[leave]);
        if (leave < 0 || wins_tie || (ratio < tightest && (!is_tie || !is_stable))) {
          leave = row;
          tightest = ratio;
        }
      }
      if (leave < 0 && gain > rounding_gain) {
        result.is_bounded = false;
        return result;
      }
    }
    if (leave < 0) break;
    tableau.row(leave) /= tableau(leave, enter);
    for (Eigen::Index row = 0; row <= num_rows; ++row) {
      if (row != leave) tableau.row(row) -= tableau(row, enter) * tableau.row(leave);
    }
    basis[leave] = enter;
  }

  result.x = Eigen::VectorXd::Zero(num_variables);
  for (Eigen::Index row = 0; row < num_rows; ++row) {
    if (basis[row] < num_variables) result.x[basis[row]] = tableau(row, num_columns);
  }
  result.value = c.dot(result.x);
  return result;
}

}  // namespace graspbench
