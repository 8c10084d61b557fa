#include "human_study/statistics/reml.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "core/base/text/text.h"
#include "core/base/units.h"
#include "core/statistics/distributions.h"

namespace graspbench {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kSingularTheta = 1e-4;  // as lme4's isSingular

/** Products of whole matrices, compiled once: expressions, each of a type of its own, made this file
the one that took longest to compile. The kernels are the same, and so are the bits. */
///@{
MatrixXd Multiply(const MatrixXd& a, const MatrixXd& b) { return a * b; }
VectorXd Apply(const MatrixXd& a, const VectorXd& b) { return a * b; }
MatrixXd MultiplyTransposed(const MatrixXd& a, const MatrixXd& b) { return a.transpose() * b; }
VectorXd ApplyTransposed(const MatrixXd& a, const VectorXd& b) { return a.transpose() * b; }
MatrixXd MultiplyByTransposed(const MatrixXd& a, const MatrixXd& b) { return a * b.transpose(); }
MatrixXd MultiplyOuter(const VectorXd& a, const VectorXd& b) { return a * b.transpose(); }
///@}

/** An entry of Lambda. */
struct Entry {
  Index row = 0, column = 0;
  Index parameter = 0;
};

std::vector<Entry> ListEntries(const RemlStructure& structure, Index num_columns) {
  std::vector<Entry> entries;
  Index parameter = 0;
  for (Index column = 0; column < structure.num_correlated; ++column) {
    for (Index row = column; row < structure.num_correlated; ++row) {
      entries.push_back({row, column, parameter++});
    }
  }
  Index next = structure.num_correlated;
  for (const int block : structure.blocks) {
    for (int i = 0; i < block; ++i, ++next) entries.push_back({next, next, parameter});
    ++parameter;
  }
  for (; next < num_columns; ++next) entries.push_back({next, next, parameter});
  return entries;
}

/** One person's sums of products; X orthonormal over all, y its residuals. */
struct Products {
  MatrixXd zz, zx, xx;
  VectorXd zy, xy;
  double yy = 0.0;
  std::vector<Entry> entries;
};

MatrixXd MakeLambda(const Products& group, const VectorXd& theta) {
  MatrixXd lambda = MatrixXd::Zero(group.zz.rows(), group.zz.rows());
  for (const Entry& entry : group.entries) lambda(entry.row, entry.column) = theta(entry.parameter);
  return lambda;
}

/** Of one person at some theta: weight = (I + Z^T Z G)^-1, so that Z^T V^-1 v = weight Z^T v. */
struct Weights {
  MatrixXd lambda, weight, zvz, zvx;
  VectorXd zvy;
  double log_det = 0.0;

  Weights(const Products& group, const VectorXd& theta) : lambda(MakeLambda(group, theta)) {
    MatrixXd to_invert = Multiply(group.zz, MultiplyByTransposed(lambda, lambda));
    to_invert.diagonal().array() += 1.0;
    const Eigen::PartialPivLU<MatrixXd> lu(to_invert);
    weight = lu.inverse();
    log_det = std::log(std::abs(lu.determinant()));
    zvz = Multiply(weight, group.zz);
    zvx = Multiply(weight, group.zx);
    zvy = Apply(weight, group.zy);
  }
};

/** The criterion's parts and their derivatives by theta. */
struct Terms {
  double log_dets = 0.0;
  double quadratic = 0.0;
  VectorXd beta;
  MatrixXd c_inverse;
  VectorXd log_dets_slope, quadratic_slope;
};

Terms CalcTerms(const std::vector<Products>& groups, const VectorXd& theta) {
  const Index p = groups.front().xx.rows();
  Terms terms;
  MatrixXd c = MatrixXd::Zero(p, p);
  VectorXd xvy = VectorXd::Zero(p);
  double yvy = 0.0;
  std::vector<Weights> weights;
  weights.reserve(groups.size());
  for (const Products& group : groups) {
    const Weights& own = weights.emplace_back(group, theta);
    const MatrixXd g = MultiplyByTransposed(own.lambda, own.lambda);
    const VectorXd gzvy = Apply(g, own.zvy);
    c += group.xx - MultiplyTransposed(group.zx, Multiply(g, own.zvx));
    xvy += group.xy - ApplyTransposed(group.zx, gzvy);
    yvy += group.yy - group.zy.dot(gzvy);
    terms.log_dets += own.log_det;
  }
  const Eigen::LLT<MatrixXd> llt(0.5 * (c + c.transpose()));
  const MatrixXd identity = MatrixXd::Identity(p, p);
  terms.c_inverse = llt.solve(identity);
  terms.log_dets += 2.0 * llt.matrixLLT().diagonal().array().log().sum();
  terms.beta = llt.solve(xvy);
  terms.quadratic = yvy - xvy.dot(terms.beta);
  terms.log_dets_slope = terms.quadratic_slope = VectorXd::Zero(theta.size());
  for (size_t i = 0; i < groups.size(); ++i) {
    const Weights& own = weights[i];
    const VectorXd u = own.zvy - Apply(own.zvx, terms.beta);  // Z^T V^-1 r
    const MatrixXd by_log_dets =
        2.0 * Multiply(own.zvz - MultiplyByTransposed(Multiply(own.zvx, terms.c_inverse), own.zvx),
                       own.lambda);
    const MatrixXd by_quadratic = MultiplyOuter(-2.0 * u, ApplyTransposed(own.lambda, u));
    for (const Entry& entry : groups[i].entries) {
      terms.log_dets_slope(entry.parameter) += by_log_dets(entry.row, entry.column);
      terms.quadratic_slope(entry.parameter) += by_quadratic(entry.row, entry.column);
    }
  }
  return terms;
}

/** Central differences of a gradient, made symmetric. */
template <typename Gradient>
MatrixXd CalcHessian(const VectorXd& at, double step, const Gradient& calc_gradient) {
  MatrixXd hessian(at.size(), at.size());
  for (Index i = 0; i < at.size(); ++i) {
    VectorXd above = at, below = at;
    const double own = step * std::max(std::abs(at(i)), 0.1);
    above(i) += own;
    below(i) -= own;
    hessian.col(i) = (calc_gradient(above) - calc_gradient(below)) / (above(i) - below(i));
  }
  return 0.5 * (hessian + hessian.transpose());
}

/** The criterion with beta and sigma profiled out, without its constants. */
struct Profile {
  double value = 0.0;
  VectorXd gradient;

  Profile(const std::vector<Products>& groups, double df, const VectorXd& theta) {
    const Terms terms = CalcTerms(groups, theta);
    value = terms.log_dets + df * std::log(terms.quadratic);
    gradient = terms.log_dets_slope + df / terms.quadratic * terms.quadratic_slope;
  }
};

VectorXd MakeStart(const Products& group, Index num_parameters) {
  VectorXd theta = VectorXd::Zero(num_parameters);
  for (const Entry& entry : group.entries) {
    if (entry.row == entry.column) theta(entry.parameter) = 1.0;
  }
  return theta;
}

/** Newton's method with the curvature's magnitude, so that every step goes downhill, shortened
until the criterion falls by a share of what its slope promises (Armijo). The criterion depends on
L L^T alone: signs of L need no bounds, and a step to -L would change nothing for ever. */
Answer<VectorXd> FindTheta(const std::vector<Products>& groups, double df, VectorXd theta) {
  constexpr int kMaxSteps = 200;
  Profile profile(groups, df, theta);
  for (int step = 0; step < kMaxSteps; ++step) {
    const MatrixXd hessian = CalcHessian(
        theta, 1e-5, [&](const VectorXd& at) { return Profile(groups, df, at).gradient; });
    if (!hessian.allFinite()) break;
    const Eigen::SelfAdjointEigenSolver<MatrixXd> curvature(hessian);
    const VectorXd& values = curvature.eigenvalues();
    const double largest = values.cwiseAbs().maxCoeff();
    const VectorXd magnitudes = values.cwiseAbs().cwiseMax(1e-10 * largest);
    const MatrixXd& axes = curvature.eigenvectors();
    VectorXd move = -Apply(axes, ApplyTransposed(axes, profile.gradient).cwiseQuotient(magnitudes));
    const double longest = 1.0 + theta.norm();
    if (move.norm() > longest) move *= longest / move.norm();

    Profile next(groups, df, theta + move);
    const auto falls = [&] {
      return next.value <= profile.value + 1e-4 * profile.gradient.dot(move);
    };
    while (!falls() && move.norm() > 1e-10 * longest) {
      move *= 0.5;
      next = Profile(groups, df, theta + move);
    }
    if (falls()) {
      theta += move;
      profile = next;
    }
    if (move.norm() <= 1e-9 * longest) return theta;
  }
  return NoAnswer{"the likelihood has no clear maximum (" + std::to_string(kMaxSteps) + " steps)"};
}

/** Where an entry of Lambda's diagonal is 0 the criterion's slope by it is 0 too, so a way to 0 ends
there even if the criterion falls on both sides. Each of them is tried again from elsewhere. */
Answer<VectorXd> FindBestTheta(const std::vector<Products>& groups, double df,
                               const VectorXd& start) {
  constexpr double kAway = 0.3, kGain = 1e-9;
  Answer<VectorXd> best = FindTheta(groups, df, start);
  for (bool improves = true; best && improves;) {
    improves = false;
    const VectorXd from = *best;
    double lowest = Profile(groups, df, from).value;
    for (Index i = 0; i < from.size(); ++i) {
      if (start(i) == 0.0 || std::abs(from(i)) >= kSingularTheta) continue;  // not of the diagonal
      VectorXd again = from;
      again(i) = kAway;
      const Answer<VectorXd> other = FindTheta(groups, df, again);
      if (!other) continue;
      const double value = Profile(groups, df, *other).value;
      if (value >= lowest - kGain * (1.0 + std::abs(lowest))) continue;
      lowest = value;
      best = other;
      improves = true;
    }
  }
  return best;
}

/** What persons' own effects cannot take up of a column: its residuals about Z_p. */
VectorXd TakeOut(const MatrixXd& z, const VectorXd& column) {
  if (z.cols() == 0) return column;
  const Eigen::ColPivHouseholderQR<MatrixXd> qr(z);
  return column - Apply(z, qr.solve(column));
}

/** Why fixed and random effects together leave nothing to estimate the residual from. */
std::string FindNoResidual(const std::vector<RemlGroup>& groups, const MatrixXd& x,
                           const VectorXd& y) {
  MatrixXd x_left(x.rows(), x.cols());
  VectorXd y_left(y.size());
  Index first = 0, num_taken = 0;
  for (const RemlGroup& group : groups) {
    const Index n = group.y.size();
    for (Index column = 0; column < x.cols(); ++column) {
      x_left.col(column).segment(first, n) = TakeOut(group.z, group.x.col(column));
    }
    y_left.segment(first, n) = TakeOut(group.z, y.segment(first, n));
    if (group.z.cols() > 0) num_taken += Eigen::ColPivHouseholderQR<MatrixXd>(group.z).rank();
    first += n;
  }
  // What is left of a column that persons explain is rounding, and no rank.
  for (Index column = 0; column < x.cols(); ++column) {
    if (x_left.col(column).norm() <= 1e-9 * x.col(column).norm()) x_left.col(column).setZero();
  }
  Eigen::ColPivHouseholderQR<MatrixXd> qr(x_left.rows(), x_left.cols());
  qr.setThreshold(1e-9);
  qr.compute(x_left);
  const Index left = y.size() - num_taken - qr.rank();
  if (left <= 0) {
    return std::to_string(y.size()) +
           " trials are no more than the fixed and random effects: no residual to compare with";
  }
  VectorXd residual = y_left;
  if (qr.rank() > 0) residual -= Apply(x_left, qr.solve(y_left));
  if (residual.norm() <= 1e-12 * y.norm() || y.norm() == 0.0) {
    return "the effects explain every trial: no residual to compare with";
  }
  return "";
}

/** sigma and what CalcDf needs, at the optimum. */
void FillParameterCovariance(const std::vector<Products>& groups, double df, const Terms& terms,
                             const MatrixXd& back, RemlFit& fit) {
  const Index n = fit.theta.size();
  const double sigma = fit.sigma, sigma2 = sigma * sigma;
  MatrixXd hessian(n + 1, n + 1);
  hessian.topLeftCorner(n, n) = CalcHessian(fit.theta, 1e-4, [&](const VectorXd& at) {
    const Terms near = CalcTerms(groups, at);
    return VectorXd(near.log_dets_slope + near.quadratic_slope / sigma2);
  });
  hessian.col(n).head(n) = -2.0 * terms.quadratic_slope / (sigma2 * sigma);
  hessian.row(n).head(n) = hessian.col(n).head(n).transpose();
  hessian(n, n) = 4.0 * df / sigma2;
  fit.parameter_covariance = 2.0 * hessian.inverse();

  const Index p = fit.beta.size();
  fit.covariance_slopes.assign(static_cast<size_t>(n + 1), MatrixXd::Zero(p, p));
  for (const Products& group : groups) {
    const Weights own(group, fit.theta);
    const MatrixXd f = MultiplyByTransposed(Multiply(own.zvx, terms.c_inverse), back);
    const MatrixXd lf = MultiplyTransposed(own.lambda, f);
    for (const Entry& entry : group.entries) {
      const MatrixXd half =
          MultiplyOuter(sigma2 * f.row(entry.row).transpose(), lf.row(entry.column).transpose());
      fit.covariance_slopes[static_cast<size_t>(entry.parameter)] += half + half.transpose();
    }
  }
  fit.covariance_slopes.back() = 2.0 / sigma * fit.covariance;
}

/** lmerTest's degrees of freedom of the mean of squared t values. */
double CombineDf(const std::vector<double>& dfs) {
  const auto [low, high] = std::minmax_element(dfs.begin(), dfs.end());
  if (*high - *low < 1e-8 * *high) return *low;
  if (*low <= 2.0) return 2.0;
  double sum = 0.0;
  for (const double df : dfs) sum += df / (df - 2.0);
  return 2.0 * sum / (sum - static_cast<double>(dfs.size()));
}

}  // namespace

int RemlStructure::num_parameters() const {
  return num_correlated * (num_correlated + 1) / 2 + static_cast<int>(blocks.size()) +
         (has_shared ? 1 : 0);
}

MatrixXd RemlFit::CalcCovariance(int num_correlated) const {
  MatrixXd factor = MatrixXd::Zero(num_correlated, num_correlated);
  Index parameter = 0;
  for (Index column = 0; column < num_correlated; ++column) {
    for (Index row = column; row < num_correlated; ++row) factor(row, column) = theta(parameter++);
  }
  return sigma * sigma * MultiplyByTransposed(factor, factor);
}

Answer<double> RemlFit::CalcDf(const VectorXd& contrast) const {
  if (is_singular) {
    return NoAnswer{"singular fit: a variance between persons is zero or their correlation is 1"};
  }
  VectorXd slope(static_cast<Index>(covariance_slopes.size()));
  for (Index i = 0; i < slope.size(); ++i) {
    slope(i) = contrast.dot(Apply(covariance_slopes[i], contrast));
  }
  const double variance = contrast.dot(Apply(covariance, contrast));
  const double df = 2.0 * variance * variance / slope.dot(Apply(parameter_covariance, slope));
  if (!(df >= 0.5)) {
    return NoAnswer{"the likelihood is too flat: less than half a degree of freedom"};
  }
  return df;
}

Answer<RemlFTest> RemlFit::TestContrasts(const MatrixXd& contrasts) const {
  const MatrixXd own = MultiplyByTransposed(Multiply(contrasts, covariance), contrasts);
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(own);
  const VectorXd& variances = eigen.eigenvalues();
  if (variances.minCoeff() <= 1e-12 * variances.maxCoeff()) {
    return NoAnswer{"the contrasts depend on each other"};
  }
  RemlFTest test;
  test.df_1 = static_cast<double>(contrasts.rows());
  std::vector<double> dfs;
  for (Index i = 0; i < variances.size(); ++i) {
    const VectorXd contrast = ApplyTransposed(contrasts, eigen.eigenvectors().col(i));
    const Answer<double> df = CalcDf(contrast);
    if (!df) return df.none();
    dfs.push_back(*df);
    const double estimate = contrast.dot(beta);
    test.f += estimate * estimate / variances(i) / test.df_1;
  }
  test.df_2 = CombineDf(dfs);
  test.p = CalcFisherUpperP(test.f, test.df_1, test.df_2);
  return test;
}

Answer<RemlFit> FitReml(const std::vector<RemlGroup>& groups, const RemlStructure& structure) {
  Index num_rows = 0;
  for (const RemlGroup& group : groups) num_rows += group.y.size();
  const Index p = groups.front().x.cols();
  if (num_rows <= p) {
    return NoAnswer{FormatCount(static_cast<int>(num_rows), "trial") + " for " +
                    FormatCount(static_cast<int>(p), "fixed effect")};
  }
  MatrixXd x(num_rows, p);
  VectorXd y(num_rows);
  Index first = 0;
  for (const RemlGroup& group : groups) {
    x.middleRows(first, group.x.rows()) = group.x;
    y.segment(first, group.y.size()) = group.y;
    first += group.y.size();
  }
  // X is made orthonormal and y free of it: neither changes the fit, both keep its digits.
  if (Eigen::ColPivHouseholderQR<MatrixXd>(x).rank() < p) {
    return NoAnswer{"the fixed effects depend on each other"};
  }
  const Eigen::HouseholderQR<MatrixXd> qr(x);
  const MatrixXd r = qr.matrixQR().topRows(p).triangularView<Eigen::Upper>();
  const MatrixXd q = qr.householderQ() * MatrixXd::Identity(num_rows, p);
  const VectorXd ordinary = r.triangularView<Eigen::Upper>().solve(ApplyTransposed(q, y));
  const VectorXd residual = y - Apply(x, ordinary);
  if (residual.norm() <= 1e-14 * y.norm()) {
    return NoAnswer{"the effects explain every trial: no residual to compare with"};
  }
  const std::string no_residual = FindNoResidual(groups, x, residual);
  if (!no_residual.empty()) return NoAnswer{no_residual};

  std::vector<Products> products;
  first = 0;
  for (const RemlGroup& group : groups) {
    const Index n = group.y.size();
    const MatrixXd own = q.middleRows(first, n);
    const VectorXd own_y = residual.segment(first, n);
    products.push_back({MultiplyTransposed(group.z, group.z), MultiplyTransposed(group.z, own),
                        MultiplyTransposed(own, own), ApplyTransposed(group.z, own_y),
                        ApplyTransposed(own, own_y), own_y.squaredNorm(),
                        ListEntries(structure, group.z.cols())});
    first += n;
  }
  const double df = static_cast<double>(num_rows - p);
  const Answer<VectorXd> theta =
      FindBestTheta(products, df, MakeStart(products.front(), structure.num_parameters()));
  if (!theta) return theta.none();

  const Terms terms = CalcTerms(products, *theta);
  const MatrixXd identity = MatrixXd::Identity(p, p);
  const MatrixXd back = r.triangularView<Eigen::Upper>().solve(identity);
  RemlFit fit;
  fit.theta = *theta;
  fit.sigma = std::sqrt(terms.quadratic / df);
  fit.beta = ordinary + Apply(back, terms.beta);
  const MatrixXd half = fit.sigma * fit.sigma * Multiply(back, terms.c_inverse);
  fit.covariance = MultiplyByTransposed(half, back);
  fit.criterion = terms.log_dets + df * (1.0 + std::log(2.0 * kPi * terms.quadratic / df)) +
                  2.0 * r.diagonal().cwiseAbs().array().log().sum();
  for (const Products& group : products) {
    for (const Entry& entry : group.entries) {
      fit.is_singular |=
          entry.row == entry.column && std::abs((*theta)(entry.parameter)) < kSingularTheta;
    }
    const Weights own(group, *theta);
    fit.random.push_back(
        Apply(MultiplyByTransposed(own.lambda, own.lambda), own.zvy - Apply(own.zvx, terms.beta)));
  }
  if (!fit.is_singular) FillParameterCovariance(products, df, terms, back, fit);
  return fit;
}

}  // namespace graspbench
