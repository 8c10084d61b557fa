#include "core/physics/step_solver.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <type_traits>
#include <vector>

namespace graspbench {
namespace {

/** Number of columns that are finished before the rest of the matrix is updated. */
constexpr int kBlock = 8;
constexpr int kUnblockedBelow = 32;
/** Number of columns of a block that are solved together. */
constexpr int kPanel = 4;

template <int kRows>
using Rows = Eigen::Array<double, kRows, 1>;

template <int kRows>
auto MapRows(double* x) {
  return Eigen::Map<Rows<kRows>>(x);
}

/** Calls strip(rows, first row) for strips that cover [begin, end). The number of rows is a
constant, so that their sums stay in registers. */
template <class Strip>
void ForEachStrip(int begin, int end, Strip&& strip) {
  int i = begin;
  for (; i + 8 <= end; i += 8) strip(std::integral_constant<int, 8>(), i);
  if (i + 4 <= end) {
    strip(std::integral_constant<int, 4>(), i);
    i += 4;
  }
  if (i + 2 <= end) {
    strip(std::integral_constant<int, 2>(), i);
    i += 2;
  }
  if (i < end) strip(std::integral_constant<int, 1>(), i);
}

/** First non-zero column of each row; earlier entries stay zero in the factor. */
using RowStarts = std::vector<int>;

const RowStarts& FindRowStarts(const Eigen::MatrixXd& H) {
  thread_local RowStarts starts;
  starts.resize(static_cast<size_t>(H.rows()));
  for (int i = 0; i < static_cast<int>(H.rows()); ++i) {
    int j = 0;
    while (j < i && H(i, j) == 0.0) ++j;
    starts[i] = j;
  }
  return starts;
}

/** H_ic -= sum over j in [first, last) of H_ij H_cj, rows i in [begin, end), columns c = k, .. */
template <int kColumns>
void SubtractProducts(Eigen::MatrixXd& H, int first, int last, int k, int begin, int end) {
  const Eigen::Index n = H.rows();
  double* data = H.data();
  ForEachStrip(begin, end, [&](auto num_rows, int i) {
    std::array<Rows<num_rows>, kColumns> sum;
    for (auto& s : sum) s.setZero();
    for (int j = first; j < last; ++j) {
      const Rows<num_rows> rows = MapRows<num_rows>(data + j * n + i);
      for (int c = 0; c < kColumns; ++c) sum[c] += rows * data[j * n + k + c];
    }
    for (int c = 0; c < kColumns; ++c) MapRows<num_rows>(data + (k + c) * n + i) -= sum[c];
  });
}

/** Factors the block of rows and columns [begin, end). */
bool FactorBlock(Eigen::MatrixXd& H, const RowStarts& starts, int begin, int end) {
  for (int k = begin; k < end; ++k) {
    double* column = H.col(k).data();
    const int first = std::max(begin, starts[k]);
    if (k > first) SubtractProducts<1>(H, first, k, k, k, end);
    if (column[k] <= 0.0) return false;
    const double root = std::sqrt(column[k]);
    column[k] = root;
    for (int i = k + 1; i < end; ++i) column[i] /= root;
  }
  return true;
}

/** Solves the rows below a factored block. */
void SolveBelow(Eigen::MatrixXd& H, const RowStarts& starts, int begin, int end) {
  const Eigen::Index n = H.rows();
  double* data = H.data();
  for (int k = begin; k < end; ++k) {
    const int panel = begin + (k - begin) / kPanel * kPanel;
    const int first = std::max(begin, starts[k]);
    const double inverse = 1.0 / H(k, k);
    ForEachStrip(end, static_cast<int>(n), [&](auto num_rows, int i) {
      auto rows_at = [&](int j) { return MapRows<num_rows>(data + j * n + i); };
      Rows<num_rows> x = rows_at(k);
      if (panel > first) {
        Rows<num_rows> sum = Rows<num_rows>::Zero();
        for (int j = first; j < panel; ++j) sum += rows_at(j) * data[j * n + k];
        x -= sum;
      }
      for (int j = std::max(panel, first); j < k; ++j) x -= rows_at(j) * data[j * n + k];
      rows_at(k) = x * inverse;
    });
  }
}

/** Updates the columns after the finished columns [begin, end). */
void UpdateBehind(Eigen::MatrixXd& H, const RowStarts& starts, int begin, int end) {
  const int n = static_cast<int>(H.rows());
  int k = end;
  for (; k + 2 <= n; k += 2) {
    const int first = std::max(begin, starts[k]);
    const int first_of_both = std::max(begin, std::min(starts[k], starts[k + 1]));
    if (first < end) SubtractProducts<1>(H, first, end, k, k, k + 1);
    if (first_of_both < end) SubtractProducts<2>(H, first_of_both, end, k, k + 1, n);
  }
  const int first = k < n ? std::max(begin, starts[k]) : end;
  if (first < end) SubtractProducts<1>(H, first, end, k, k, n);
}

}  // namespace

bool FactorCholesky(Eigen::MatrixXd& H) {
  const int n = static_cast<int>(H.rows());
  const RowStarts& starts = FindRowStarts(H);
  const int block = n < kUnblockedBelow ? std::max(n, 1) : kBlock;
  for (int begin = 0; begin < n; begin += block) {
    const int end = std::min(begin + block, n);
    if (!FactorBlock(H, starts, begin, end)) return false;
    SolveBelow(H, starts, begin, end);
    UpdateBehind(H, starts, begin, end);
  }
  return true;
}

namespace {

/** A friction limit may lag behind by this share of the normal force. */
constexpr double kLimitShare = 1e-3;
constexpr double kLimitForce = 1e-6;  ///< [N]
/** No limit is extrapolated farther than this multiple of a pass's change. */
constexpr double kMostMixing = 10.0;
/** A mixed limit is at least this share of the pass's result. */
constexpr double kLeastShare = 0.5;
/** The factor is reused while gains of a pad or a yielding surface change by less than this share.
*/
constexpr double kPadGainShare = 1e-3;
/** A factor of an earlier step is discarded when it leaves more of the residual. */
constexpr double kStaleShare = 0.01;

/** Calls `function` with the number of rows as a constant, which unrolls loops over rows. */
template <class Function>
void WithRows(int num_rows, Function&& function) {
  if (num_rows == 1) {
    function(std::integral_constant<int, 1>());
  } else if (num_rows == 3) {
    function(std::integral_constant<int, 3>());
  } else {
    function(std::integral_constant<int, 4>());
  }
}

template <int kRows>
ContactRates CalcRatesOf(const ContactPoint& contact, const Eigen::VectorXd& v) {
  ContactRates rates = {0.0, 0.0, 0.0, 0.0};
  for (int i = 0; i < contact.num_dofs; ++i) {
    const double speed = v[contact.dofs[i]];
    for (int row = 0; row < kRows; ++row) rates[row] += contact.jacobian[row][i] * speed;
  }
  return rates;
}

template <int kRows>
void SubtractImpulse(const ContactPoint& contact, const ContactRates& impulse,
                     Eigen::VectorXd& residual) {
  for (int i = 0; i < contact.num_dofs; ++i) {
    double value = residual[contact.dofs[i]];
    for (int row = 0; row < kRows; ++row) value -= contact.jacobian[row][i] * impulse[row];
    residual[contact.dofs[i]] = value;
  }
}

/** Adds h J^T G J to the lower triangle of H; only the normal row for kRows = 1. */
template <int kRows>
void AddStiffness(const ContactPoint& contact, const ContactGains& gains, double h,
                  Eigen::MatrixXd& H) {
  using Row = std::array<double, ContactPoint::kMaxDofs>;
  const std::array<Row, kNumContactRows>& J = contact.jacobian;
  const std::array<double, 6>& g = gains.friction;
  const int n = contact.num_dofs;
  Row normal, tangent1, tangent2, spin, sum;  // h J^T G
  for (int i = 0; i < n; ++i) {
    normal[i] = h * gains.normal * J[kNormalRow][i];
    if constexpr (kRows >= 3) {
      tangent1[i] = h * (g[0] * J[kTangentRow1][i] + g[1] * J[kTangentRow2][i]);
      tangent2[i] = h * (g[1] * J[kTangentRow1][i] + g[2] * J[kTangentRow2][i]);
    }
    if constexpr (kRows == 4) {
      tangent1[i] += h * g[3] * J[kSpinRow][i];
      tangent2[i] += h * g[4] * J[kSpinRow][i];
      spin[i] = h * (g[3] * J[kTangentRow1][i] + g[4] * J[kTangentRow2][i] + g[5] * J[kSpinRow][i]);
    }
  }
  for (int j = 0; j < n; ++j) {
    const double J_n = J[kNormalRow][j], J_1 = J[kTangentRow1][j], J_2 = J[kTangentRow2][j];
    const double J_s = J[kSpinRow][j];
    for (int i = j; i < n; ++i) {
      sum[i] = normal[i] * J_n;
      if constexpr (kRows >= 3) sum[i] += tangent1[i] * J_1 + tangent2[i] * J_2;
      if constexpr (kRows == 4) sum[i] += spin[i] * J_s;
    }
    // The degrees of freedom of a contact ascend, so this stays in the lower triangle.
    double* column = H.col(contact.dofs[j]).data();
    for (int i = j; i < n; ++i) column[contact.dofs[i]] += sum[i];
  }
}

/** Whether gains differ by at most this share of the largest one. */
bool AreAlike(const ContactGains& a, const ContactGains& b, double share) {
  if (share == 0.0) return a.normal == b.normal && a.friction == b.friction;
  double largest = 0.0, change = 0.0;
  for (size_t i = 0; i < a.friction.size(); ++i) {
    largest = std::max(largest, std::abs(b.friction[i]));
    change = std::max(change, std::abs(a.friction[i] - b.friction[i]));
  }
  return std::abs(a.normal - b.normal) <= share * b.normal && change <= share * largest;
}

bool IsInsideClamp(const ScalarForce& scalar, double v) {
  const double tau = scalar.offset - scalar.gain * v;
  return tau > scalar.lower && tau < scalar.upper;
}

}  // namespace

void StepSolver::CalcRates(const StepProblem& problem, const Eigen::VectorXd& v,
                           std::vector<ContactRates>& rates) const {
  rates.resize(problem.contacts.size());
  for (size_t c = 0; c < problem.contacts.size(); ++c) {
    const ContactPoint& contact = problem.contacts[c];
    WithRows(contact.num_rows(), [&](auto rows) { rates[c] = CalcRatesOf<rows>(contact, v); });
  }
}

void StepSolver::CalcMotion(const StepProblem& problem, const Eigen::VectorXd& v) {
  direction_ = v - problem.u;
  momentum_.noalias() = problem.M * direction_;
  CalcRates(problem, v, rates_);
}

void StepSolver::CalcResidual(const StepProblem& problem, const Eigen::VectorXd& v) {
  const double h = problem.h;
  residual_ = momentum_ + h * problem.bias;
  for (const ScalarForce& scalar : problem.scalars) {
    residual_[scalar.dof] -= h * scalar.Calc(v[scalar.dof]);
  }
  forces_.resize(problem.contacts.size());
  for (size_t c = 0; c < problem.contacts.size(); ++c) {
    const ContactPoint& contact = problem.contacts[c];
    forces_[c] = CalcContactForces(contact, rates_[c], h);
    ContactRates impulse;
    for (int row = 0; row < kNumContactRows; ++row) impulse[row] = h * forces_[c].force[row];
    if (impulse == ContactRates()) continue;
    WithRows(contact.num_rows(),
             [&](auto rows) { SubtractImpulse<rows>(contact, impulse, residual_); });
  }
}

double StepSolver::CalcSlope(const StepProblem& problem, const Eigen::VectorXd& v,
                             double alpha) const {
  const double h = problem.h;
  double slope = M_direction_.dot(v - problem.u) + alpha * M_direction_.dot(direction_) +
                 h * problem.bias.dot(direction_);
  for (const ScalarForce& scalar : problem.scalars) {
    const double d = direction_[scalar.dof];
    slope -= h * scalar.Calc(v[scalar.dof] + alpha * d) * d;
  }
  for (size_t c = 0; c < problem.contacts.size(); ++c) {
    const ContactPoint& contact = problem.contacts[c];
    const int num_rows = contact.num_rows();
    ContactRates rates;
    for (int row = 0; row < num_rows; ++row) {
      rates[row] = rates_[c][row] + alpha * direction_rates_[c][row];
    }
    const ContactForces forces = CalcContactForces(contact, rates, h);
    for (int row = 0; row < num_rows; ++row) {
      slope -= h * forces.force[row] * direction_rates_[c][row];
    }
  }
  return slope;
}

bool StepSolver::UpdateFactor(const StepProblem& problem, const Eigen::VectorXd& v) {
  bool is_same = has_factor_ && gains_.size() == problem.contacts.size() &&
                 is_inside_.size() == problem.scalars.size();
  gains_.resize(problem.contacts.size());
  for (size_t c = 0; c < problem.contacts.size(); ++c) {
    const ContactPoint& contact = problem.contacts[c];
    const GainKey key = {contact.link, contact.num_dofs,
                         CalcContactGains(contact, rates_[c], forces_[c], problem.h)};
    GainKey& last = gains_[c];
    is_same = is_same && key.link == last.link && key.num_dofs == last.num_dofs &&
              AreAlike(key.gains, last.gains, contact.is_nonlinear() ? kPadGainShare : 0.0);
    if (!is_same || !contact.is_nonlinear()) last = key;
  }
  is_inside_.resize(problem.scalars.size());
  scalar_gains_.resize(problem.scalars.size());
  for (size_t i = 0; i < problem.scalars.size(); ++i) {
    const ScalarForce& scalar = problem.scalars[i];
    const bool is_inside = IsInsideClamp(scalar, v[scalar.dof]);
    is_same = is_same && is_inside == is_inside_[i] && scalar.gain == scalar_gains_[i];
    is_inside_[i] = is_inside;
    scalar_gains_[i] = scalar.gain;
  }
  is_fresh_ = !is_same;
  if (is_same) return true;
  CalcHessian(problem);
  has_factor_ = FactorCholesky(H_);
  return has_factor_;
}

/** Writes M + h J^T G J to the lower triangle of H_. */
void StepSolver::CalcHessian(const StepProblem& problem) {
  const double h = problem.h;
  H_ = problem.M;
  for (size_t i = 0; i < problem.scalars.size(); ++i) {
    const ScalarForce& scalar = problem.scalars[i];
    if (is_inside_[i]) H_(scalar.dof, scalar.dof) += h * scalar.gain;
  }
  for (size_t c = 0; c < problem.contacts.size(); ++c) {
    const ContactPoint& contact = problem.contacts[c];
    const ContactGains& gains = gains_[c].gains;
    const auto& g = gains.friction;
    const bool has_friction = g[0] + g[2] + g[5] > 0.0;
    if (gains.normal == 0.0 && !has_friction) continue;
    WithRows(has_friction ? contact.num_rows() : 1,
             [&](auto rows) { AddStiffness<rows>(contact, gains, h, H_); });
  }
}

/** The slope along the direction rises monotonically. Finds its zero when the full step overshoots.
*/
double StepSolver::SearchAlong(const StepProblem& problem, const Eigen::VectorXd& v,
                               double slope_at_start, double slope) const {
  double alpha = 1.0;
  double low = 0.0, high = 1.0, slope_low = slope_at_start, slope_high = slope;
  for (int k = 0; k < 20 && std::abs(slope) > 0.1 * std::abs(slope_at_start); ++k) {
    alpha = low - slope_low * (high - low) / (slope_high - slope_low);
    // Regula falsi may stick to one end, so bisect every third time.
    if (k % 3 == 2) alpha = 0.5 * (low + high);
    slope = CalcSlope(problem, v, alpha - 1.0);
    if (slope > 0.0) {
      high = alpha;
      slope_high = slope;
    } else {
      low = alpha;
      slope_low = slope;
    }
  }
  return alpha;
}

void StepSolver::MoveAlong(double share, Eigen::VectorXd& v) {
  v += share * direction_;
  momentum_ += share * M_direction_;
  for (size_t c = 0; c < rates_.size(); ++c) {
    for (int row = 0; row < kNumContactRows; ++row) {
      rates_[c][row] += share * direction_rates_[c][row];
    }
  }
}

bool StepSolver::SolvePass(StepProblem& problem, Eigen::VectorXd& v) {
  CalcResidual(problem, v);
  for (int iteration = 0; iteration < kMaxIterations; ++iteration) {
    const double miss = CalcMiss();
    if (!(miss > looseness_)) return residual_.allFinite();

    if (!UpdateFactor(problem, v)) return false;
    direction_ = -residual_;
    H_.triangularView<Eigen::Lower>().solveInPlace(direction_);
    H_.adjoint().triangularView<Eigen::Upper>().solveInPlace(direction_);
    if (!direction_.allFinite()) {
      Forget();
      return false;
    }
    M_direction_.noalias() = problem.M * direction_;
    CalcRates(problem, direction_, direction_rates_);

    const double slope_at_start = residual_.dot(direction_);
    MoveAlong(1.0, v);
    CalcResidual(problem, v);
    const double slope = residual_.dot(direction_);
    if (slope > 0.1 * std::abs(slope_at_start)) {
      MoveAlong(SearchAlong(problem, v, slope_at_start, slope) - 1.0, v);
      CalcResidual(problem, v);
    }
    if (!is_fresh_ && CalcMiss() > kStaleShare * miss) Forget();
  }
  return CalcMiss() <= looseness_;
}

bool StepSolver::RefreshFrictionLimits(StepProblem& problem) {
  bool changed = false;
  limits_before_.swap(limits_);
  limits_.assign(problem.contacts.size(), FrictionLimit());
  for (size_t c = 0; c < problem.contacts.size(); ++c) {
    ContactPoint& contact = problem.contacts[c];
    if (!contact.memory) continue;
    const ContactForces& f = forces_[c];
    const double fn = f.force[kNormalRow];
    // A limit from a smaller normal force does not indicate sliding yet.
    if (f.is_at_limit && contact.friction_limit >= (1.0 - kLimitShare) * contact.mu() * fn) {
      contact.is_dynamic = true;
    }
    const double limit = contact.mu() * fn;
    const double spin = contact.material.torsion_radius > 0.0
                            ? f.force[kSpinRow] / contact.material.torsion_radius
                            : 0.0;
    const bool matters =
        f.is_at_limit || std::hypot(f.force[kTangentRow1], f.force[kTangentRow2], spin) > limit;
    if (matters && std::abs(limit - contact.friction_limit) > kLimitShare * fn + kLimitForce) {
      changed = true;
    }
    limits_[c] = {contact.friction_limit, limit - contact.friction_limit, contact.is_dynamic};
  }
  if (changed) MixLimits(problem);
  return changed;
}

/** Anderson mixing. With the residuals f of the last two passes and g = x + f:
x = g - theta (g - g_before), where theta minimises f - theta (f - f_before). */
void StepSolver::MixLimits(StepProblem& problem) const {
  double product = 0.0, square = 0.0;
  bool is_same_law = limits_before_.size() == limits_.size();
  for (size_t c = 0; c < limits_.size() && is_same_law; ++c) {
    const FrictionLimit &last = limits_[c], &before = limits_before_[c];
    is_same_law = last.is_dynamic == before.is_dynamic;
    const double change = last.miss - before.miss;
    product += change * last.miss;
    square += change * change;
  }
  const bool is_mixed = is_same_law && square > 0.0;
  const double theta = is_mixed ? std::clamp(product / square, -kMostMixing, kMostMixing) : 0.0;
  for (size_t c = 0; c < limits_.size(); ++c) {
    const double next = limits_[c].used + limits_[c].miss;
    double& limit = problem.contacts[c].friction_limit;
    limit = next;
    if (is_mixed) {
      limit -= theta * (next - limits_before_[c].used - limits_before_[c].miss);
      limit = std::max(limit, kLeastShare * next);
    }
  }
}

}  // namespace graspbench
