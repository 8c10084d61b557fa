#pragma once
/** @file
One implicit step: solves for the speeds v at its end,

    M (v - u) + h b = h ( drives(v) + limits(v) + sum J^T f(J v) )

With fixed friction limits, every force on the right is minus the gradient of a convex potential of
v. So Newton's method with an exact line search always finds the unique solution. The limits are
then recomputed from the new normal forces until they agree. This fixed-point iteration is
accelerated by Anderson mixing of the last two passes, which converges quickly even if contacts are
wedged (Walker and Ni 2011). Both parts are needed: without them light objects diverge and slipping
heavy ones stall.

An iteration costs a dense Cholesky factorisation of at most 36 unknowns, or none if the last speeds
already solve the step. The factor is reused, also across steps, while no gain of a contact or drive
has changed (for a pad, by more than a thousandth). Mass matrix and contacts change so little that
the next residual shows whether the factor is still good enough. */

#include <Eigen/Core>
#include <algorithm>
#include <vector>

#include "core/physics/contact.h"

namespace graspbench {

/** A force on one degree of freedom, piecewise linear in its speed: tau = clamp(offset - gain v,
lower, upper). Used for drives and joint limits. */
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
  /** In addition, the residual must not give a degree of freedom alone more than this speed [m/s,
  rad/s]. With the first tolerance alone, a thin disc of 1 g would turn by 3e-3 rad/s in every
  step. */
  static constexpr double kSpeedTolerance = 1e-5;
  /** Factor on the tolerances while limits and bias still change. */
  static constexpr double kLooseness = 100.0;
  static constexpr int kMaxIterations = 50;  ///< Newton iterations per pass
  static constexpr int kMaxPasses = 30;      ///< passes over friction limits and bias

  /** Solves for v, starting from its value. `refresh_bias(v)` is called between passes, may change
  problem.bias and returns whether it did. Returns false if the tolerance was not reached or if
  limits and bias did not converge. Contacts keep their limits and forces for FinishContact. */
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
    SolvePass(problem, v);  // at the last limits
    return false;
  }

  /** Discards the factor of earlier steps. */
  void Forget() { has_factor_ = false; }

  const std::vector<ContactRates>& rates() const { return rates_; }
  const std::vector<ContactForces>& forces() const { return forces_; }

 private:
  bool SolvePass(StepProblem& problem, Eigen::VectorXd& v);
  /** Updates the factor to the gains at v; returns false if there is none. */
  bool UpdateFactor(const StepProblem& problem, const Eigen::VectorXd& v);
  void CalcHessian(const StepProblem& problem);
  /** Finds the step length along the direction.
  @param v  a full step along the direction, where the slope is `slope`
  @returns the share of that step to take. */
  double SearchAlong(const StepProblem& problem, const Eigen::VectorXd& v, double slope_at_start,
                     double slope) const;
  void MoveAlong(double share, Eigen::VectorXd& v);
  /** Updates the friction limits if a relevant one was off; returns whether one was. */
  bool RefreshFrictionLimits(StepProblem& problem);
  void MixLimits(StepProblem& problem) const;
  void CalcRates(const StepProblem& problem, const Eigen::VectorXd& v,
                 std::vector<ContactRates>& rates) const;
  /** Computes what depends on v alone, not on limits and bias: momentum and contact rates. */
  void CalcMotion(const StepProblem& problem, const Eigen::VectorXd& v);
  /** @pre CalcMotion at v. */
  void CalcResidual(const StepProblem& problem, const Eigen::VectorXd& v);
  double CalcSlope(const StepProblem& problem, const Eigen::VectorXd& v, double alpha) const;
  /** Returns the largest ratio of a residual to its tolerance: at most 1 when solved, and at most
  `looseness_` meanwhile. */
  double CalcMiss() const { return (residual_.array().abs() / tolerance_.array()).maxCoeff(); }

  struct FrictionLimit {
    double used = 0.0;  ///< in the last pass [N]
    double miss = 0.0;  ///< resulting mu fn minus `used` [N]
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
  std::vector<GainKey> gains_;   // by contact, as in the factor
  std::vector<bool> is_inside_;  // by scalar, as in the factor: between its bounds
  std::vector<double> scalar_gains_;
  bool has_factor_ = false;
  double looseness_ = 1.0;
  bool is_fresh_ = false;     // the factor is from this iteration
  Eigen::VectorXd momentum_;  // M (v - u)
  Eigen::VectorXd residual_, direction_, M_direction_;
  Eigen::VectorXd tolerance_;  // of the residual
  Eigen::MatrixXd H_;          // lower triangle; then the factor
};

/** Cholesky factorisation of small matrices for the solver's inner loop: replaces the lower
triangle of H, the only part that is read, by L of H = L L^T. Returns false if H is not positive
definite.

Sums run in the order of Eigen 3.4's LLT, so the results are identical bit for bit for sizes that
are multiples of 4 or below 32. It takes less than half the time at some 30 unknowns, because
nothing is packed, copied or dispatched. Zeros before the first entry of a row, as between the
joints of two fingers, are skipped. @pre square. */
bool FactorCholesky(Eigen::MatrixXd& H);

}  // namespace graspbench
