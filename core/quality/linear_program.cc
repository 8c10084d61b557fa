#include "core/quality/linear_program.h"

#include <algorithm>
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
constexpr double kRelief = 1e-8;           // of the largest bound, see Relieve

constexpr double kViolation = 1e-7;  // of rows and prices; more is no optimum

/** Columns: variables, slacks, right-hand side. The last row holds minus the gains. A pivot works on
whole rows, so they lie in one piece. */
struct Tableau {
  Eigen::Index num_rows, num_columns;  // without the last ones
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> values;
  std::vector<Eigen::Index> basis;  // the variable each row stands for
};

Tableau MakeTableau(const Eigen::MatrixXd& A, const Eigen::VectorXd& b, const Eigen::VectorXd& c) {
  const Eigen::Index num_rows = A.rows(), num_variables = A.cols();
  Tableau tableau;
  tableau.num_rows = num_rows;
  tableau.num_columns = num_variables + num_rows;
  tableau.values = Eigen::MatrixXd::Zero(num_rows + 1, tableau.num_columns + 1);
  tableau.values.topLeftCorner(num_rows, num_variables) = A;
  tableau.values.block(0, num_variables, num_rows, num_rows).setIdentity();
  tableau.values.col(tableau.num_columns).head(num_rows) = b;
  tableau.values.row(num_rows).head(num_variables) = -c.transpose();
  for (Eigen::Index row = 0; row < num_rows; ++row) tableau.basis.push_back(num_variables + row);
  return tableau;
}

/** Of the rows that limit the entering variable most, the one with the largest pivot, which keeps
rounding small; or, when it is not `is_stable`, the one with the first variable (Bland's rule); -1
when no row limits it. */
Eigen::Index FindLeavingRow(const Tableau& tableau, Eigen::Index enter, bool is_stable) {
  Eigen::Index leave = -1;
  double tightest = 0.0;
  for (Eigen::Index row = 0; row < tableau.num_rows; ++row) {
    const double pivot = tableau.values(row, enter);
    if (pivot <= kSmallestPivot) continue;
    const double ratio = tableau.values(row, tableau.num_columns) / pivot;
    const bool is_tie = leave >= 0 && std::abs(ratio - tightest) <= kTie;
    const bool wins_tie =
        is_tie && (is_stable ? pivot > tableau.values(leave, enter)
                             : ratio == tightest && tableau.basis[row] < tableau.basis[leave]);
    if (leave < 0 || wins_tie || (ratio < tightest && (!is_tie || !is_stable))) {
      leave = row;
      tightest = ratio;
    }
  }
  return leave;
}

void Pivot(Eigen::Index enter, Eigen::Index leave, Tableau& tableau) {
  auto& values = tableau.values;
  values.row(leave) /= values(leave, enter);
  for (Eigen::Index row = 0; row <= tableau.num_rows; ++row) {
    const double factor = values(row, enter);
    if (row != leave && factor != 0.0) values.row(row) -= factor * values.row(leave);
  }
  tableau.basis[leave] = enter;
}

/** The variable that gains most for its share; -1 when none gains (Dantzig's rule: fewer pivots). */
Eigen::Index FindSteepest(const Tableau& tableau) {
  Eigen::Index steepest = -1;
  const double gain =
      -tableau.values.row(tableau.num_rows).head(tableau.num_columns).minCoeff(&steepest);
  return gain > kZero ? steepest : -1;
}

/** Which variable enters first of all. */
enum class Entry { kSteepest, kFirst };

/** Pivots until nothing gains. */
LinearProgramEnd RunSimplex(Entry entry, double rounding_gain, Tableau& tableau) {
  // After so many steps it might cycle, which Bland's rule prevents, but for rounding.
  const Eigen::Index num_stable_steps = kStableSteps * (tableau.num_rows + tableau.num_columns);
  for (Eigen::Index step = 0; step <= 4 * num_stable_steps; ++step) {
    const bool is_stable = step < num_stable_steps;
    const bool by_gain = is_stable && entry == Entry::kSteepest;
    Eigen::Index enter = by_gain ? FindSteepest(tableau) : -1, leave = -1;
    if (enter >= 0) leave = FindLeavingRow(tableau, enter, is_stable);
    // Where that one is not limited, or under Bland's rule, the first variable that gains enters. A
    // tiny gain that no row limits is rounding, not a way to infinity.
    for (Eigen::Index column = 0; column < tableau.num_columns && leave < 0; ++column) {
      const double gain = -tableau.values(tableau.num_rows, column);
      if (gain <= kZero) continue;
      enter = column;
      leave = FindLeavingRow(tableau, enter, is_stable);
      if (leave < 0 && gain > rounding_gain) return LinearProgramEnd::kUnbounded;
    }
    if (leave < 0) return LinearProgramEnd::kOptimum;
    Pivot(enter, leave, tableau);
  }
  return LinearProgramEnd::kLost;
}

/** Whether x is feasible and the prices y of the rows prove it the best (weak duality): the tableau
it was read from carries the rounding of every step. */
bool IsOptimum(const Eigen::MatrixXd& A, const Eigen::VectorXd& b, const Eigen::VectorXd& c,
               const Eigen::VectorXd& x, const Eigen::VectorXd& y) {
  const double size = std::max(1.0, b.maxCoeff()), price = std::max(1.0, c.maxCoeff());
  return (A * x - b).maxCoeff() <= kViolation * size && x.minCoeff() >= -kViolation * size &&
         (c - A.transpose() * y).maxCoeff() <= kViolation * price &&
         y.minCoeff() >= -kViolation * price && b.dot(y) - c.dot(x) <= kViolation * price * size;
}

LinearProgramResult SolveOnce(Entry entry, const Eigen::MatrixXd& A, const Eigen::VectorXd& b,
                              const Eigen::VectorXd& c) {
  const Eigen::Index num_rows = b.size(), num_variables = c.size();
  Tableau tableau = MakeTableau(A, b, c);
  const double rounding_gain = num_variables > 0 ? kRoundingGain * c.cwiseAbs().maxCoeff() : 0.0;
  LinearProgramResult result;
  result.end = RunSimplex(entry, rounding_gain, tableau);
  result.x = Eigen::VectorXd::Zero(num_variables);
  for (Eigen::Index row = 0; row < num_rows; ++row) {
    const Eigen::Index variable = tableau.basis[row];
    if (variable < num_variables) result.x[variable] = tableau.values(row, tableau.num_columns);
  }
  result.value = c.dot(result.x);
  const Eigen::VectorXd prices =
      tableau.values.row(num_rows).segment(num_variables, num_rows).transpose();
  if (result.end == LinearProgramEnd::kOptimum && num_rows > 0 && num_variables > 0 &&
      !IsOptimum(A, b, c, result.x, prices)) {
    result.end = LinearProgramEnd::kLost;
  }
  return result;
}

/** Bounds a little wider, each by another amount, so that no two rows tie: what is lost to rounding
in a program full of ties is found in this one, at a price of about kRelief times the prices of the
rows. */
Eigen::VectorXd Relieve(const Eigen::VectorXd& b) {
  const double largest = std::max(b.maxCoeff(), 1e-300);
  Eigen::VectorXd relieved = b;
  for (Eigen::Index row = 0; row < b.size(); ++row) {
    // Multiples of the golden ratio, of which no two differ by little.
    const double share = std::fmod((row + 1) * 0.6180339887498949, 1.0);
    relieved[row] += kRelief * largest * (1.0 + share);
  }
  return relieved;
}

}  // namespace

LinearProgramResult SolveLinearProgram(const Eigen::MatrixXd& A, const Eigen::VectorXd& b,
                                       const Eigen::VectorXd& c) {
  const Eigen::Index num_rows = A.rows(), num_variables = A.cols();
  GRASPBENCH_DEMAND(b.size() == num_rows && c.size() == num_variables,
                    "sizes: " + std::to_string(b.size()) + ", " + std::to_string(c.size()));
  GRASPBENCH_DEMAND(num_rows == 0 || b.minCoeff() >= 0.0, "a negative bound");

  // The steepest variable first takes fewest steps, the first one loses least to rounding.
  LinearProgramResult result = SolveOnce(Entry::kSteepest, A, b, c);
  if (result.end == LinearProgramEnd::kOptimum || num_rows == 0) return result;
  result = SolveOnce(Entry::kFirst, A, b, c);
  if (result.end == LinearProgramEnd::kOptimum) return result;
  return SolveOnce(Entry::kFirst, A, Relieve(b), c);
}

}  // namespace graspbench
