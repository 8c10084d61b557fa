#pragma once
/** @file
A small dense linear program:

    maximise c.x   subject to   A x <= b,  x >= 0,      with b >= 0

so that x = 0 is feasible and no first phase is needed. An equality is two inequalities. Simplex
method on a full tableau. Our programs are degenerate throughout (b = 0 in every row of the force
balance): of the rows that tie the largest pivot is taken, so that rounding stays small, and if that
takes too long Bland's rule, which cannot cycle (R. G. Bland, Math. Oper. Res. 2, 1977).

Meant for what this folder needs: up to a few dozen rows and a few hundred variables of similar
size, the same bits on every run, from any thread, and no package for it. For anything larger take a
solver. */

#include <Eigen/Core>
#include <memory>
#include <vector>

namespace graspbench {

enum class LinearProgramEnd {
  kOptimum,    ///< proven by the prices of the rows
  kUnbounded,  ///< c.x grows without limit
  kLost,       ///< rounding hides the optimum: numbers too far apart
};

struct LinearProgramResult {
  LinearProgramEnd end = LinearProgramEnd::kOptimum;  ///< else the others mean nothing
  double value = 0.0;                                 ///< c.x at the optimum
  Eigen::VectorXd x;                                  ///< an optimal point (num_variables)
  Eigen::VectorXd prices;                             ///< of the rows: d value / d b (num_rows)
};

/** A program whose variables may be added one by one: Solve goes on from the last optimum. */
class LinearProgram {
 public:
  /** @param b  (num_rows) >= 0. */
  explicit LinearProgram(const Eigen::VectorXd& b);
  /** @param column  of A (num_rows)  @param gain  its entry of c; all finite. */
  void AddVariable(const Eigen::VectorXd& column, double gain);
  ~LinearProgram();
  /** What rounding hides is looked for again from the beginning, then with bounds that are wider by
  1e-8 of the largest. */
  LinearProgramResult Solve();

 private:
  struct Tableau;
  LinearProgramResult SolveOnce(bool steepest_first);

  Eigen::MatrixXd A_;  // wider than there are variables
  Eigen::VectorXd b_;
  std::vector<double> c_;
  std::unique_ptr<Tableau> tableau_;
};

/** @param A (num_rows x num_variables)  @param b (num_rows) >= 0  @param c (num_variables); all
finite. */
LinearProgramResult SolveLinearProgram(const Eigen::MatrixXd& A, const Eigen::VectorXd& b,
                                       const Eigen::VectorXd& c);

}  // namespace graspbench
