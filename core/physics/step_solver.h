#pragma once
/** @file
One implicit step: the speeds v at its end, from

    M (v - u) + h b = h ( drives(v) + limits(v) + sum J^T f(J v) )

With the friction limits held fixed every force on the right is minus the gradient of a convex
potential of v, so Newton with an exact line search always finds the one solution; then the limits
are taken from the new normal forces until they agree, a fixed point that Anderson's mixing of the
last two passes reaches quickly where contacts are wedged (Walker and Ni 2011). Both details are
needed: without them light objects blow up and slipping heavy ones stall. Cost: a dense Cholesky
factor of at most 36 unknowns per iteration, none when the last speeds solve the step already. The
factor serves on while no contact's or drive's gain has changed, of a pad by more than a thousandth,
from step to step too: mass matrix and contacts move so little that the next residual shows whether
it still does. */

#include <Eigen/Core>
#include <algorithm>
#include <vector>

#include "core/physics/contact.h"

namespace graspbench {

/** A force on one degree of freedom, piecewise linear in its speed:
tau = clamp(offset - gain v, lower, upper). Drives and joint limits. */
struct ScalarForce {
  int dof = -1;
  double offset = 0.0;  ///< [N m]
  double gain = 0.0;    ///< >= 0 [N m s/rad]
  double lower = 0.0;   ///< [N m]
  double upper = 0.0;

  double Calc(double v) const { return std::clamp(offset - gain * v, lower, upper); }
};

struct StepProblem {
  double h = 0.0;        ///< [s]
  Eigen::MatrixXd M;     ///< (n x n), symmetric positive definite
  Eigen::VectorXd u;     ///< (n) speeds at the start
  Eigen::VectorXd bias;  ///< (n)
  std::vector<ScalarForce> scalars;
  std::vector<ContactPoint> contacts;
};

class StepSolver {
 public:
  static constexpr double kTolerance = 1e-9;  ///< largest impulse residual [N s, N m s]
  /** And at most what gives a degree of freedom alone this speed: a thin disc of 1 g would turn by
  3e-3 rad/s for the other, in every step again [m/s, rad/s]. */
  static constexpr double kSpeedTolerance = 1e-5;
  /** While limits and bias still change, a pass may miss the tolerances by this factor. */
  static constexpr double kLooseness = 100.0;
  static constexpr int kMaxIterations = 50;  ///< of Newton, per pass
  static constexpr int kMaxPasses = 30;      ///< of friction limits and bias

  /** Solves for v, starting from its value. `refresh_bias(v)` is called between passes and may
  change problem.bias; it returns whether it did. False when the tolerance was not reached or limits
  and bias did not settle. Contacts keep their limits and forces for FinishContact. */
  template <class RefreshBias>
  bool Solve(StepProblem& problem, Eigen::VectorXd& v, RefreshBias&& refresh_bias) {
    limits_.clear();
    tolerance_ = (kSpeedTolerance * problem.M.diagonal()).cwiseMin(kTolerance);
    CalcMotion(problem, v);
    looseness_ = kLooseness;
    for (int pass = 0; pass < kMaxPasses; ++pass) {
      const bool converged = SolvePass(problem, v);
      const bool limits_changed = RefreshFrictionLimits(problem);
      const bool bias_changed = refresh_bias(v);
      if (limits_changed || bias_changed) continue;
      if (looseness_ == 1.0 || CalcMiss() <= 1.0) return converged;
      looseness_ = 1.0;
    }
    looseness_ = 1.0;
    SolvePass(problem, v);  // with the last limits
    return false;
  }

  /** Nothing of earlier steps is used any more. */
  void Forget() { has_factor_ = false; }

  const std::vector<ContactRates>& rates() const { return rates_; }
  const std::vector<ContactForces>& forces() const { return forces_; }

 private:
  bool SolvePass(StepProblem& problem, Eigen::VectorXd& v);
  /** Brings the factor to the gains at v; false when there is none. */
  bool UpdateFactor(const StepProblem& problem, const Eigen::VectorXd& v);
  void CalcHessian(const StepProblem& problem);
  /** @param v  a full step along the direction, where the slope is `slope`   @return how much of
  that step to take. */
  double SearchAlong(const StepProblem& problem, const Eigen::VectorXd& v, double slope_at_start,
                     double slope) const;
  void MoveAlong(double share, Eigen::VectorXd& v);
  /** Returns whether a limit that matters was off; only then moves them. */
  bool RefreshFrictionLimits(StepProblem& problem);
  void MixLimits(StepProblem& problem) const;
  void CalcRates(const StepProblem& problem, const Eigen::VectorXd& v,
                 std::vector<ContactRates>& rates) const;
  /** What follows from v alone, whatever limits and bias are: momentum and rates of contacts. */
  void CalcMotion(const StepProblem& problem, const Eigen::VectorXd& v);
  /** @pre CalcMotion at v. */
  void CalcResidual(const StepProblem& problem, const Eigen::VectorXd& v);
  double CalcSlope(const StepProblem& problem, const Eigen::VectorXd& v, double alpha) const;
  /** Largest residual over its tolerance: at most 1 when solved, `looseness_` for now. */
  double CalcMiss() const { return (residual_.array().abs() / tolerance_.array()).maxCoeff(); }

  struct FrictionLimit {
    double used = 0.0;  ///< in the last pass [N]
    double miss = 0.0;  ///< mu fn that came of it, less `used` [N]
    bool is_dynamic = false;
  };

  std::vector<FrictionLimit> limits_;          // of the last pass; empty in the first
  std::vector<FrictionLimit> limits_before_;   // of the pass before
  std::vector<ContactRates> rates_;            // at v
  std::vector<ContactRates> direction_rates_;  // J d
  std::vector<ContactForces> forces_;          // at v
  struct GainKey {
    int link, num_dofs;
    ContactGains gains;
  };
  std::vector<GainKey> gains_;   // by contact, of the factor
  std::vector<bool> is_inside_;  // by scalar, of the factor: between its bounds
  std::vector<double> scalar_gains_;
  bool has_factor_ = false;
  double looseness_ = 1.0;
  bool is_fresh_ = false;     // the factor is of this iteration
  Eigen::VectorXd momentum_;  // M (v - u)
  Eigen::VectorXd residual_, direction_, M_direction_;
  Eigen::VectorXd tolerance_;  // of the residual
  Eigen::MatrixXd H_;          // its lower triangle; then the factor
};

/** The factor of small symmetric matrices in the solver's inner loop.

Sums run in the order of Eigen 3.4's LLT, so the results are the same bits where its sizes are
multiples of 4 or below 32; it takes less than half the time, because nothing is packed, copied or
dispatched at some 30 unknowns. Zeros before the first entry of a row, as between the joints of two
fingers, are skipped.

L of H = L L^T in place of H's lower triangle, which alone is read; false when H is not positive
definite. @pre square. */
bool FactorCholesky(Eigen::MatrixXd& H);

}  // namespace graspbench
