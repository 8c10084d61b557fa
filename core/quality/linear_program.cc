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

/** Columns: right-hand side, slacks, variables. The last row holds minus the gains. A pivot works
on whole rows, so they lie in one piece. */
struct Simplex {
  Eigen::Index num_rows, num_columns;  // in use, without the last row
  bool has_pivoted = false;
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> values;
  std::vector<Eigen::Index> basis;  // the column each row stands for
};

Simplex MakeSimplex(const Eigen::VectorXd& b) {
  Simplex tableau{b.size(), b.size() + 1, false, {}, {}};
  tableau.values = Eigen::MatrixXd::Zero(b.size() + 1, 4 * (b.size() + 1));
  tableau.values.col(0).head(b.size()) = b;
  tableau.values.block(0, 1, b.size(), b.size()).setIdentity();
  for (Eigen::Index row = 0; row < b.size(); ++row) tableau.basis.push_back(row + 1);
  return tableau;
}

/** The slacks' columns turn a new one into the present basis. */
void AddColumn(const Eigen::Ref<const Eigen::VectorXd>& column, double gain, Simplex& tableau) {
  auto& values = tableau.values;
  if (tableau.num_columns == values.cols()) {
    values.conservativeResize(Eigen::NoChange, 2 * values.cols());
  }
  if (tableau.has_pivoted) {
    values.col(tableau.num_columns) = values.middleCols(1, tableau.num_rows) * column;
  } else {  // the slacks' columns are those of the unit matrix
    values.col(tableau.num_columns) << column, 0.0;
  }
  values(tableau.num_rows, tableau.num_columns++) -= gain;
}

/** Of the rows that limit the entering variable most, the one with the largest pivot, which keeps
rounding small; or, when it is not `is_stable`, the one with the first variable (Bland's rule); -1
when no row limits it. */
Eigen::Index FindLeavingRow(const Simplex& tableau, Eigen::Index enter, bool is_stable) {
  Eigen::Index leave = -1;
  double tightest = 0.0;
  for (Eigen::Index row = 0; row < tableau.num_rows; ++row) {
    const double pivot = tableau.values(row, enter);
    if (pivot <= kSmallestPivot) continue;
    const double ratio = tableau.values(row, 0) / pivot;
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

void Pivot(Eigen::Index enter, Eigen::Index leave, Simplex& tableau) {
  auto& values = tableau.values;
  auto pivot_row = values.row(leave).head(tableau.num_columns);
  pivot_row /= values(leave, enter);
  for (Eigen::Index row = 0; row <= tableau.num_rows; ++row) {
    const double factor = values(row, enter);
    if (row == leave || factor == 0.0) continue;
    values.row(row).head(tableau.num_columns) -= factor * pivot_row;
  }
  tableau.basis[leave] = enter;
  tableau.has_pivoted = true;
}

/** The variable that gains most for its share; -1 when none gains (Dantzig's rule: fewer pivots). */
Eigen::Index FindSteepest(const Simplex& tableau) {
  Eigen::Index steepest = -1;
  const double gain =
      -tableau.values.row(tableau.num_rows).segment(1, tableau.num_columns - 1).minCoeff(&steepest);
  return gain > kZero ? steepest + 1 : -1;
}

/** Which variable enters first of all. */
enum class Entry { kSteepest, kFirst };

/** Pivots until nothing gains. */
LinearProgramEnd RunSimplex(Entry entry, double rounding_gain, Simplex& tableau) {
  // After so many steps it might cycle, which Bland's rule prevents, but for rounding.
  const Eigen::Index num_stable_steps = kStableSteps * (tableau.num_rows + tableau.num_columns);
  for (Eigen::Index step = 0; step <= 4 * num_stable_steps; ++step) {
    const bool is_stable = step < num_stable_steps;
    const bool by_gain = is_stable && entry == Entry::kSteepest;
    Eigen::Index enter = by_gain ? FindSteepest(tableau) : -1, leave = -1;
    if (enter >= 0) leave = FindLeavingRow(tableau, enter, is_stable);
    // Where that one is not limited, or under Bland's rule, the first variable that gains enters. A
    // tiny gain that no row limits is rounding, not a way to infinity.
    for (Eigen::Index column = 1; column < tableau.num_columns && leave < 0; ++column) {
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

struct LinearProgram::Tableau : Simplex {};

LinearProgram::LinearProgram(const Eigen::VectorXd& b)
    : A_(b.size(), 0), b_(b), tableau_(new Tableau{MakeSimplex(b)}) {
  GRASPBENCH_DEMAND(b.size() == 0 || b.minCoeff() >= 0.0, "a negative bound");
}

LinearProgram::~LinearProgram() = default;

void LinearProgram::AddVariable(const Eigen::VectorXd& column, double gain) {
  GRASPBENCH_DEMAND(column.size() == b_.size(), "size: " + std::to_string(column.size()));
  const auto index = static_cast<Eigen::Index>(c_.size());
  if (index == A_.cols()) A_.conservativeResize(Eigen::NoChange, 2 * index + 32);
  A_.col(index) = column;
  c_.push_back(gain);
  AddColumn(column, gain, *tableau_);
}

LinearProgramResult LinearProgram::SolveOnce(bool steepest_first) {
  const Eigen::Map<const Eigen::VectorXd> c(c_.data(), static_cast<Eigen::Index>(c_.size()));
  const double rounding_gain = c.size() > 0 ? kRoundingGain * c.cwiseAbs().maxCoeff() : 0.0;
  LinearProgramResult result;
  result.end =
      RunSimplex(steepest_first ? Entry::kSteepest : Entry::kFirst, rounding_gain, *tableau_);
  result.x = Eigen::VectorXd::Zero(c.size());
  for (Eigen::Index row = 0; row < b_.size(); ++row) {
    const Eigen::Index variable = tableau_->basis[static_cast<size_t>(row)] - b_.size() - 1;
    if (variable >= 0) result.x[variable] = tableau_->values(row, 0);
  }
  result.value = c.dot(result.x);
  result.prices = tableau_->values.row(b_.size()).segment(1, b_.size()).transpose();
  if (result.end == LinearProgramEnd::kOptimum && b_.size() > 0 && c.size() > 0 &&
      !IsOptimum(A_.leftCols(c.size()), b_, c, result.x, result.prices)) {
    result.end = LinearProgramEnd::kLost;
  }
  return result;
}

LinearProgramResult LinearProgram::Solve() {
  // The steepest variable first takes fewest steps, the first one loses least to rounding.
  LinearProgramResult result = SolveOnce(true);
  for (const bool is_relieved : {false, true}) {
    if (result.end == LinearProgramEnd::kOptimum || b_.size() == 0) return result;
    if (is_relieved) b_ = Relieve(b_);
    *tableau_ = Tableau{MakeSimplex(b_)};
    for (size_t i = 0; i < c_.size(); ++i) {
      AddColumn(A_.col(static_cast<Eigen::Index>(i)), c_[i], *tableau_);
    }
    result = SolveOnce(false);
  }
  return result;
}

LinearProgramResult SolveLinearProgram(const Eigen::MatrixXd& A, const Eigen::VectorXd& b,
                                       const Eigen::VectorXd& c) {
  GRASPBENCH_DEMAND(b.size() == A.rows() && c.size() == A.cols(),
                    "sizes: " + std::to_string(b.size()) + ", " + std::to_string(c.size()));
  LinearProgram program(b);
  for (Eigen::Index i = 0; i < c.size(); ++i) program.AddVariable(A.col(i), c[i]);
  return program.Solve();
}

}  // namespace graspbench
