#pragma once
/** @file
A small dense linear program:

    maximise c.x   subject to   A x <= b,  x >= 0,      with b >= 0

so that x = 0 is feasible and no first phase is needed. An equality is two inequalities. It uses the
simplex method on a full tableau. Our programs are highly degenerate (b = 0 in every row of the
force balance). Among tied rows the largest pivot is chosen, to keep rounding small. If this takes
too long, Bland's rule is used, which cannot cycle (R. G. Bland, Math. Oper. Res. 2, 1977).

It is meant for the needs of this folder: up to a few dozen rows and a few hundred variables of
similar magnitude. Results are identical bit for bit on every run and thread, without any package.
Use a solver library for larger programs. */

#include <Eigen/Core>
#include <memory>
#include <vector>

namespace graspbench {

enum class LinearProgramEnd {
  kOptimum,    ///< proven by the dual prices of the rows
  kUnbounded,  ///< c.x grows without limit
  kLost,       ///< rounding hides the optimum: magnitudes differ too much
};

struct LinearProgramResult {
  LinearProgramEnd end = LinearProgramEnd::kOptimum;  ///< unless optimal, the rest is invalid
  double value = 0.0;                                 ///< c.x at the optimum
  Eigen::VectorXd x;                                  ///< an optimal point (num_variables)
  Eigen::VectorXd prices;                             ///< dual prices: d value / d b (num_rows)
};

/** A program to which variables can be added one by one: Solve continues from the last optimum. */
class LinearProgram {
 public:
  /** @param b  (num_rows) >= 0. */
  explicit LinearProgram(const Eigen::VectorXd& b);
  /** Adds a variable.
  @param column  of A (num_rows)  @param gain  its entry of c; all finite. */
  void AddVariable(const Eigen::VectorXd& column, double gain);
  ~LinearProgram();
  /** Solves the program. If rounding hides the optimum, it restarts from the beginning, and then
  with bounds widened by 1e-8 of the largest. */
  LinearProgramResult Solve();

 private:
  struct Tableau;
  LinearProgramResult SolveOnce(bool steepest_first);

  Eigen::MatrixXd A_;  // has spare columns
  Eigen::VectorXd b_;
  std::vector<double> c_;
  std::unique_ptr<Tableau> tableau_;
};

/** Solves a program at once.
@param A (num_rows x num_variables)  @param b (num_rows) >= 0  @param c (num_variables); all
finite. */
LinearProgramResult SolveLinearProgram(const Eigen::MatrixXd& A, const Eigen::VectorXd& b,
                                       const Eigen::VectorXd& c);

}  // namespace graspbench
