#include "human_study/statistics/mixed_model.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <map>

#include "core/statistics/distributions.h"
#include "core/statistics/summary.h"
#include "human_study/statistics/reml.h"

namespace graspbench {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;
using Eigen::VectorXd;

/** x and y as they are, to x and y centred and x scaled. */
struct Scaling {
  double x_mean = 0.0, x_scale = 1.0, y_mean = 0.0;

  /** Coefficients of [1 x] from those of [1 (x - mean) / scale]. */
  Matrix2d MakeBack() const {
    return (Matrix2d() << 1.0, -x_mean / x_scale, 0.0, 1.0 / x_scale).finished();
  }
};

struct LineData {
  std::vector<std::string> persons;
  std::vector<RemlGroup> groups;  // x is [1, scaled x]; z to be filled
};

LineData MakeGroups(const std::vector<PersonPoint>& points, const Scaling& scaling) {
  LineData data;
  std::map<std::string, std::vector<const PersonPoint*>> own_points;
  for (const PersonPoint& point : points) {
    auto& own = own_points[point.person];
    if (own.empty()) data.persons.push_back(point.person);
    own.push_back(&point);
  }
  for (const std::string& person : data.persons) {
    const auto& own = own_points.at(person);
    RemlGroup group;
    group.x.resize(static_cast<Eigen::Index>(own.size()), 2);
    group.y.resize(group.x.rows());
    for (Eigen::Index i = 0; i < group.x.rows(); ++i) {
      const PersonPoint& point = *own[static_cast<size_t>(i)];
      group.x.row(i) << 1.0, (point.x - scaling.x_mean) / scaling.x_scale;
      group.y(i) = point.y - scaling.y_mean;
    }
    data.groups.push_back(std::move(group));
  }
  return data;
}

/** No person's points leave their own line by more than rounding. */
bool HasNoResidual(const std::vector<RemlGroup>& groups, double y_scale) {
  double residual = 0.0;
  for (const RemlGroup& group : groups) {
    const VectorXd x = group.x.col(1).array() - group.x.col(1).mean();
    const VectorXd y = group.y.array() - group.y.mean();
    const double slope = x.isZero(0.0) ? 0.0 : x.dot(y) / x.squaredNorm();
    residual += (y - slope * x).squaredNorm();
  }
  return std::sqrt(residual) <= 1e-14 * y_scale;
}

constexpr double kSingular = 1e-4;  // as lme4's isSingular

/** [1 x] of the random effects: which columns of x they take. */
Eigen::Matrix2Xd MakeSelection(LineStructure structure) {
  if (structure == LineStructure::kIntercept) return Vector2d(1.0, 0.0);
  if (structure == LineStructure::kSlope) return Vector2d(0.0, 1.0);
  return Matrix2d::Identity();
}

FixedEffect MakeEffect(const RemlFit& fit, const Vector2d& contrast, double origin) {
  FixedEffect effect;
  effect.estimate = contrast.dot(fit.beta) + origin;
  effect.standard_error = std::sqrt(contrast.dot(fit.covariance * contrast));
  effect.t = effect.estimate / effect.standard_error;
  const Answer<double> df = fit.CalcDf(contrast);
  if (!df) {
    effect.test = df.none();
    return effect;
  }
  const double half_width = CalcStudentQuantile(0.975, *df) * effect.standard_error;
  effect.test = CoefficientTest{*df,
                                CalcStudentTwoSidedP(effect.t, *df),
                                {effect.estimate - half_width, effect.estimate + half_width}};
  return effect;
}

/** sigma^2 G of [1 scaled x]. */
Matrix2d CalcPsi(const RemlFit& fit, LineStructure structure) {
  if (structure == LineStructure::kCorrelated) return fit.CalcCovariance(2);
  const Eigen::Matrix2Xd selection = MakeSelection(structure);
  const VectorXd variances = fit.sigma * fit.sigma * fit.theta.cwiseAbs2();
  return selection * variances.asDiagonal() * selection.transpose();
}

/** Everything that is told in the unit of the data. */
MixedModel MakeModel(const RemlFit& fit, const LineData& data, const Scaling& scaling,
                     LineStructure structure) {
  MixedModel model;
  model.structure = structure;
  model.num_persons = static_cast<int>(data.groups.size());
  for (const RemlGroup& group : data.groups) {
    model.num_observations += static_cast<int>(group.y.size());
  }
  model.residual_sd = fit.sigma;
  model.reml_criterion = fit.criterion + 2.0 * std::log(scaling.x_scale);
  model.is_singular = fit.is_singular;

  const Matrix2d back = scaling.MakeBack();
  const Matrix2d psi = back * CalcPsi(fit, structure) * back.transpose();
  // A variance of zero may come back as a rounding error below it.
  model.intercept_sd = std::sqrt(std::max(0.0, psi(0, 0)));
  model.slope_sd = std::sqrt(std::max(0.0, psi(1, 1)));
  if (model.intercept_sd > kSingular * model.residual_sd &&
      model.slope_sd * scaling.x_scale > kSingular * model.residual_sd) {
    model.correlation = psi(1, 0) / (model.intercept_sd * model.slope_sd);
  } else {
    model.correlation = NoAnswer{"a standard deviation between persons is zero"};
  }
  model.intercept = MakeEffect(fit, back.row(0).transpose(), scaling.y_mean);
  model.slope = MakeEffect(fit, back.row(1).transpose(), 0.0);
  const Eigen::Matrix2Xd selection = MakeSelection(structure);
  for (size_t i = 0; i < data.persons.size(); ++i) {
    const Vector2d line =
        back * (fit.beta + selection * fit.random[i]) + Vector2d(scaling.y_mean, 0.0);
    model.persons.push_back({data.persons[i], line(0), line(1)});
  }
  return model;
}

}  // namespace

const char* NameOf(LineStructure structure) {
  switch (structure) {
    case LineStructure::kCorrelated:
      return "an intercept and a slope for each person";
    case LineStructure::kUncorrelated:
      return "an intercept and a slope for each person, uncorrelated at the mean level";
    case LineStructure::kIntercept:
      return "an intercept for each person, one slope for all";
    case LineStructure::kSlope:
      return "a slope for each person about one value at the mean level";
  }
  return "";
}

Answer<MixedModel> FitMixedModel(const std::vector<PersonPoint>& points, LineStructure structure) {
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
  LineData data = MakeGroups(points, scaling);
  if (data.groups.size() < 2) return NoAnswer{"1 person; expected 2 or more"};
  if (points.size() <= 2 * data.groups.size()) {
    return NoAnswer{std::to_string(points.size()) + " observations of " +
                    std::to_string(data.groups.size()) +
                    " persons; expected more than two a person"};
  }
  const double y_scale = std::abs(*std::max_element(
      y.begin(), y.end(), [](double a, double b) { return std::abs(a) < std::abs(b); }));
  if (HasNoResidual(data.groups, y_scale * std::sqrt(num_points))) {
    return NoAnswer{"every person's points lie on a line: no residual to compare with"};
  }
  RemlStructure random;
  if (structure == LineStructure::kCorrelated) {
    random.num_correlated = 2;
  } else {
    random.num_separate = structure == LineStructure::kUncorrelated ? 2 : 1;
  }
  const Eigen::Matrix2Xd selection = MakeSelection(structure);
  for (RemlGroup& group : data.groups) group.z = group.x * selection;
  const Answer<RemlFit> fit = FitReml(data.groups, random);
  if (!fit) return fit.none();
  return MakeModel(*fit, data, scaling, structure);
}

Answer<MixedModel> FitMixedModelLadder(const std::vector<PersonPoint>& points) {
  Answer<MixedModel> model = FitMixedModel(points);
  if (!model || !model->is_singular) return model;
  const auto fall_back = [&](LineStructure structure, const std::string& why) {
    Answer<MixedModel> simpler = FitMixedModel(points, structure);
    if (!simpler) return simpler;
    MixedModel own = *simpler;
    own.fallback = why;
    return Answer<MixedModel>(own);
  };
  const std::string why = "with a correlation of the two the fit is singular";
  model = fall_back(LineStructure::kUncorrelated, why);
  if (!model || !model->is_singular) return model;
  // One of the variances is zero; which one, the model without it shows.
  for (const LineStructure structure : {LineStructure::kIntercept, LineStructure::kSlope}) {
    const Answer<MixedModel> simpler = fall_back(
        structure, why + std::string("; then the variance of ") +
                       (structure == LineStructure::kIntercept ? "slopes" : "intercepts") +
                       " is zero");
    if (!simpler) return simpler;
    if (!simpler->is_singular && simpler->reml_criterion <= model->reml_criterion + 1e-5) {
      return simpler;
    }
  }
  return NoAnswer{
      "persons differ in neither intercept nor slope by more than their trials do (both variances "
      "are zero): trials of one person cannot be told from those of another"};
}

}  // namespace graspbench
