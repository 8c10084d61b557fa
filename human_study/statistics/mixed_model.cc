#include "human_study/statistics/mixed_model.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <map>

#include "core/base/units.h"
#include "core/statistics/distributions.h"
#include "core/statistics/summary.h"

namespace graspbench {
namespace {

using Eigen::Matrix2d;
using Eigen::Matrix4d;
using Eigen::MatrixX2d;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::Vector4d;
using Eigen::VectorXd;

/** One person's trials; x and y are centred and x is scaled over all persons. */
struct Group {
  std::string person;
  MatrixX2d z;  // (num_trials x 2)
  VectorXd y;
  Matrix2d s;  // z^T z
};

/** What both criteria and their derivatives are made of, for V = sigma2 I + Z psi Z^T. */
struct Terms {
  double log_det_v = 0.0;
  double log_det_c = 0.0;
  Vector2d beta = Vector2d::Zero();
  Matrix2d c_inverse = Matrix2d::Zero();
  double quadratic = 0.0;  // sum r^T V^-1 r
  // Derivatives of the log determinants and minus that of the quadratic form, by psi and by sigma2.
  Matrix2d by_psi = Matrix2d::Zero(), quadratic_by_psi = Matrix2d::Zero();
  double by_sigma2 = 0.0, quadratic_by_sigma2 = 0.0;
};

struct Parameters {
  Matrix2d psi;
  double sigma2 = 1.0;
};

/** (sigma2 I + s psi)^-1, so that Z^T V^-1 v = weight * Z^T v for any v. */
Matrix2d CalcWeight(const Group& group, const Parameters& at) {
  return (at.sigma2 * Matrix2d::Identity() + group.s * at.psi).inverse();
}

Terms CalcTerms(const std::vector<Group>& groups, const Parameters& at) {
  Terms terms;
  Matrix2d c = Matrix2d::Zero();
  Vector2d zy = Vector2d::Zero();
  for (const Group& group : groups) {
    const Matrix2d weight = CalcWeight(group, at);
    c += weight * group.s;
    zy += weight * (group.z.transpose() * group.y);
  }
  terms.c_inverse = c.inverse();
  terms.log_det_c = std::log(c.determinant());
  terms.beta = terms.c_inverse * zy;
  for (const Group& group : groups) {
    const Matrix2d weight = CalcWeight(group, at);
    const Matrix2d a = weight * group.s;                       // Z^T V^-1 Z
    const Matrix2d b = weight * group.s * weight.transpose();  // Z^T V^-2 Z
    const VectorXd r = group.y - group.z * terms.beta;
    const Vector2d u = weight * (group.z.transpose() * r);        // Z^T V^-1 r
    const VectorXd v = (r - group.z * (at.psi * u)) / at.sigma2;  // V^-1 r
    const double num_others = static_cast<double>(group.y.size()) - 2.0;
    terms.log_det_v += num_others * std::log(at.sigma2) - std::log(weight.determinant());
    terms.quadratic += r.dot(v);
    terms.by_psi += a - a * terms.c_inverse * a;
    terms.quadratic_by_psi += u * u.transpose();
    terms.by_sigma2 += num_others / at.sigma2 + weight.trace() - (terms.c_inverse * b).trace();
    terms.quadratic_by_sigma2 += v.squaredNorm();
  }
  return terms;
}

/** The profiled criterion over the lower triangle (l11, l21, l22) of G = L L^T. */
struct Profile {
  double value = 0.0;
  Vector3d gradient = Vector3d::Zero();
};

Matrix2d MakeFactor(const Vector3d& theta) {
  return (Matrix2d() << theta(0), 0.0, theta(1), theta(2)).finished();
}

Profile CalcProfile(const std::vector<Group>& groups, double df, const Vector3d& theta) {
  const Matrix2d factor = MakeFactor(theta);
  const Terms terms = CalcTerms(groups, {factor * factor.transpose(), 1.0});
  Profile profile;
  profile.value =
      terms.log_det_v + terms.log_det_c + df * (1.0 + std::log(2.0 * kPi * terms.quadratic / df));
  const Matrix2d slope =
      2.0 * (terms.by_psi - df / terms.quadratic * terms.quadratic_by_psi) * factor;
  profile.gradient = {slope(0, 0), slope(1, 0), slope(1, 1)};
  return profile;
}

/** Central differences of a gradient, made symmetric. */
template <typename Vector, typename Gradient>
auto CalcHessian(const Vector& at, const Vector& steps, const Gradient& calc_gradient) {
  Eigen::Matrix<double, Vector::RowsAtCompileTime, Vector::RowsAtCompileTime> hessian;
  for (Eigen::Index i = 0; i < at.size(); ++i) {
    Vector above = at, below = at;
    above(i) += steps(i);
    below(i) -= steps(i);
    hessian.col(i) = (calc_gradient(above) - calc_gradient(below)) / (above(i) - below(i));
  }
  return decltype(hessian)(0.5 * (hessian + hessian.transpose()));
}

/** Newton's method with the curvature's magnitude, so that every step goes downhill, shortened
until it does not climb. The criterion depends on L L^T alone, so signs of L need no bounds. */
Answer<Vector3d> FindFactor(const std::vector<Group>& groups, double df) {
  constexpr int kMaxSteps = 200;
  Vector3d theta(1.0, 0.0, 1.0);
  Profile profile = CalcProfile(groups, df, theta);
  for (int step = 0; step < kMaxSteps; ++step) {
    const Vector3d differences = 1e-5 * theta.cwiseAbs().cwiseMax(0.1);
    const Eigen::Matrix3d hessian = CalcHessian(theta, differences, [&](const Vector3d& at) {
      return CalcProfile(groups, df, at).gradient;
    });
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> curvature(hessian);
    const double largest = curvature.eigenvalues().cwiseAbs().maxCoeff();
    const Vector3d magnitudes = curvature.eigenvalues().cwiseAbs().cwiseMax(1e-10 * largest);
    Vector3d move =
        -curvature.eigenvectors() *
        (curvature.eigenvectors().transpose() * profile.gradient).cwiseQuotient(magnitudes);
    const double longest = 1.0 + theta.norm();
    if (move.norm() > longest) move *= longest / move.norm();

    Profile next = CalcProfile(groups, df, theta + move);
    while (!(next.value <= profile.value) && move.norm() > 1e-10 * longest) {
      move *= 0.5;
      next = CalcProfile(groups, df, theta + move);
    }
    if (next.value <= profile.value) {
      theta += move;
      profile = next;
    }
    if (move.norm() <= 1e-9 * longest) return theta;
  }
  return NoAnswer{"the likelihood has no clear maximum (" + std::to_string(kMaxSteps) + " steps)"};
}

/** psi11, psi21, psi22, sigma2. */
Vector4d CalcGradient(const std::vector<Group>& groups, const Vector4d& at) {
  const Terms terms =
      CalcTerms(groups, {(Matrix2d() << at(0), at(1), at(1), at(2)).finished(), at(3)});
  const Matrix2d by_psi = terms.by_psi - terms.quadratic_by_psi;
  return {by_psi(0, 0), 2.0 * by_psi(1, 0), by_psi(1, 1),
          terms.by_sigma2 - terms.quadratic_by_sigma2};
}

/** Satterthwaite's 2 v^2 / (g^T A g), v the variance of l^T beta, g its gradient and A the
covariance of the variance parameters. */
class Satterthwaite {
 public:
  Satterthwaite(const std::vector<Group>& groups, const Parameters& at) : groups_(groups), at_(at) {
    const Vector4d point(at.psi(0, 0), at.psi(1, 0), at.psi(1, 1), at.sigma2);
    const double covariance_scale = std::sqrt(point(0) * point(2));
    const Vector4d scales(point(0), covariance_scale, point(2), point(3));
    const Matrix4d hessian = CalcHessian<Vector4d>(
        point, 1e-4 * scales, [&](const Vector4d& near) { return CalcGradient(groups, near); });
    covariance_ = 2.0 * hessian.inverse();
    c_inverse_ = CalcTerms(groups, at).c_inverse;
  }

  double CalcDf(const Vector2d& contrast) const {
    const Vector2d direction = c_inverse_ * contrast;
    Vector4d gradient = Vector4d::Zero();
    for (const Group& group : groups_) {
      const Matrix2d weight = CalcWeight(group, at_);
      const Vector2d own = weight * group.s * direction;
      gradient += Vector4d(own(0) * own(0), 2.0 * own(0) * own(1), own(1) * own(1),
                           direction.dot(weight * group.s * weight.transpose() * direction));
    }
    const double variance = contrast.dot(direction);
    return 2.0 * variance * variance / gradient.dot(covariance_ * gradient);
  }

 private:
  const std::vector<Group>& groups_;
  Parameters at_;
  Matrix4d covariance_;
  Matrix2d c_inverse_;
};

FixedEffect MakeEffect(double estimate, double standard_error, const Answer<double>& df) {
  FixedEffect effect;
  effect.estimate = estimate;
  effect.standard_error = standard_error;
  effect.t = estimate / standard_error;
  if (!df) {
    effect.test = df.none();
    return effect;
  }
  if (!(*df >= 0.5)) {
    effect.test = NoAnswer{"the likelihood is too flat: less than half a degree of freedom"};
    return effect;
  }
  const double half_width = CalcStudentQuantile(0.975, *df) * standard_error;
  effect.test = CoefficientTest{
      *df, CalcStudentTwoSidedP(effect.t, *df), {estimate - half_width, estimate + half_width}};
  return effect;
}

/** x and y as they are, to x and y centred and x scaled. */
struct Scaling {
  double x_mean = 0.0, x_scale = 1.0, y_mean = 0.0;

  /** Coefficients of [1 x] from those of [1 (x - mean) / scale]. */
  Matrix2d MakeBack() const {
    return (Matrix2d() << 1.0, -x_mean / x_scale, 0.0, 1.0 / x_scale).finished();
  }
};

std::vector<Group> MakeGroups(const std::vector<PersonPoint>& points, const Scaling& scaling) {
  std::vector<std::string> persons;
  std::map<std::string, std::vector<const PersonPoint*>> own_points;
  for (const PersonPoint& point : points) {
    auto& own = own_points[point.person];
    if (own.empty()) persons.push_back(point.person);
    own.push_back(&point);
  }
  std::vector<Group> groups;
  for (const std::string& person : persons) {
    const auto& own = own_points.at(person);
    Group group;
    group.person = person;
    group.z.resize(static_cast<Eigen::Index>(own.size()), 2);
    group.y.resize(group.z.rows());
    for (Eigen::Index i = 0; i < group.z.rows(); ++i) {
      const PersonPoint& point = *own[static_cast<size_t>(i)];
      group.z.row(i) << 1.0, (point.x - scaling.x_mean) / scaling.x_scale;
      group.y(i) = point.y - scaling.y_mean;
    }
    group.s = group.z.transpose() * group.z;
    groups.push_back(std::move(group));
  }
  return groups;
}

/** No person's points leave their own line by more than rounding. */
bool HasNoResidual(const std::vector<Group>& groups, double y_scale) {
  double residual = 0.0;
  for (const Group& group : groups) {
    const VectorXd x = group.z.col(1).array() - group.z.col(1).mean();
    const VectorXd y = group.y.array() - group.y.mean();
    const double slope = x.isZero(0.0) ? 0.0 : x.dot(y) / x.squaredNorm();
    residual += (y - slope * x).squaredNorm();
  }
  return std::sqrt(residual) <= 1e-14 * y_scale;
}

constexpr double kSingular = 1e-4;  // as lme4's isSingular

/** Everything that is told in the unit of the data. */
void FillEffects(const std::vector<Group>& groups, const Scaling& scaling, const Matrix2d& relative,
                 const Terms& terms, double sigma2, MixedModel& model) {
  const Matrix2d back = scaling.MakeBack();
  const Vector2d origin(scaling.y_mean, 0.0);
  const Vector2d beta = back * terms.beta + origin;
  const Matrix2d covariance = back * (sigma2 * terms.c_inverse) * back.transpose();
  const Matrix2d psi = back * (sigma2 * relative) * back.transpose();
  // A variance of zero may come back as a rounding error below it.
  model.intercept_sd = std::sqrt(std::max(0.0, psi(0, 0)));
  model.slope_sd = std::sqrt(std::max(0.0, psi(1, 1)));
  if (model.intercept_sd > kSingular * model.residual_sd &&
      model.slope_sd * scaling.x_scale > kSingular * model.residual_sd) {
    model.correlation = psi(1, 0) / (model.intercept_sd * model.slope_sd);
  } else {
    model.correlation = NoAnswer{"a standard deviation between persons is zero"};
  }

  Answer<double> intercept_df, slope_df;
  if (model.is_singular) {
    intercept_df = slope_df =
        NoAnswer{"singular fit: a variance between persons is zero or their correlation is 1"};
  } else {
    const Satterthwaite satterthwaite(groups, {sigma2 * relative, sigma2});
    intercept_df = satterthwaite.CalcDf(back.row(0).transpose());
    slope_df = satterthwaite.CalcDf(back.row(1).transpose());
  }
  model.intercept = MakeEffect(beta(0), std::sqrt(covariance(0, 0)), intercept_df);
  model.slope = MakeEffect(beta(1), std::sqrt(covariance(1, 1)), slope_df);
  for (const Group& group : groups) {
    const VectorXd r = group.y - group.z * terms.beta;
    const Vector2d own =
        relative * (CalcWeight(group, {relative, 1.0}) * (group.z.transpose() * r));
    const Vector2d line = back * (terms.beta + own) + origin;
    model.persons.push_back({group.person, line(0), line(1)});
  }
}

}  // namespace

Answer<MixedModel> FitMixedModel(const std::vector<PersonPoint>& points) {
  std::vector<double> x, y;
  for (const PersonPoint& point : points) {
    if (!std::isfinite(point.x) || !std::isfinite(point.y)) {
      return NoAnswer{"person \"" + point.person + "\": a value is not finite"};
    }
    x.push_back(point.x);
    y.push_back(point.y);
  }
  if (points.empty()) return NoAnswer{"no observations"};
  const Moments x_moments = CalcMoments(x);
  const double num_points = static_cast<double>(points.size());
  const Scaling scaling = {x_moments.mean, std::sqrt(x_moments.sum_of_squares / num_points),
                           CalcMoments(y).mean};
  if (x_moments.is_constant) return NoAnswer{"all observations have the same x"};
  const std::vector<Group> groups = MakeGroups(points, scaling);
  if (groups.size() < 2) return NoAnswer{"1 person; expected 2 or more"};
  if (points.size() <= 2 * groups.size()) {
    return NoAnswer{std::to_string(points.size()) + " observations of " +
                    std::to_string(groups.size()) + " persons; expected more than two a person"};
  }
  const double y_scale = std::abs(*std::max_element(
      y.begin(), y.end(), [](double a, double b) { return std::abs(a) < std::abs(b); }));
  if (HasNoResidual(groups, y_scale * std::sqrt(num_points))) {
    return NoAnswer{"every person's points lie on a line: no residual to compare with"};
  }

  const double df = num_points - 2.0;
  const Answer<Vector3d> theta = FindFactor(groups, df);
  if (!theta) return theta.none();
  const Matrix2d factor = MakeFactor(*theta);
  const Matrix2d relative = factor * factor.transpose();
  const Terms terms = CalcTerms(groups, {relative, 1.0});
  const double sigma2 = terms.quadratic / df;

  MixedModel model;
  model.num_persons = static_cast<int>(groups.size());
  model.num_observations = static_cast<int>(points.size());
  model.residual_sd = std::sqrt(sigma2);
  model.reml_criterion = CalcProfile(groups, df, *theta).value + 2.0 * std::log(scaling.x_scale);
  model.is_singular = std::abs((*theta)(0)) < kSingular || std::abs((*theta)(2)) < kSingular;

  FillEffects(groups, scaling, relative, terms, sigma2, model);
  return model;
}

}  // namespace graspbench
