#include "human_study/statistics/within_anova.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <unsupported/Eigen/KroneckerProduct>

#include "core/base/text/text.h"
#include "core/statistics/distributions.h"
#include "core/statistics/summary.h"

namespace graspbench {

namespace {

using Eigen::MatrixXd;

/** (num_levels x (num_levels - 1)), orthonormal, each column sums to zero. */
MatrixXd MakeHelmert(Eigen::Index num_levels) {
  MatrixXd contrasts = MatrixXd::Zero(num_levels, num_levels - 1);
  for (Eigen::Index k = 0; k + 1 < num_levels; ++k) {
    const double count = static_cast<double>(k + 1);
    contrasts.col(k).head(k + 1).setConstant(-1.0 / count);
    contrasts(k + 1, k) = 1.0;
    contrasts.col(k).normalize();
  }
  return contrasts;
}

/** (num_levels x (num_levels - 1)), as R's contr.sum. */
MatrixXd MakeEffectCoding(Eigen::Index num_levels) {
  MatrixXd coding = MatrixXd::Zero(num_levels, num_levels - 1);
  coding.topRows(num_levels - 1).setIdentity();
  coding.row(num_levels - 1).setConstant(-1.0);
  return coding;
}

/** (num_cells x d); an empty effect gives the scaled mean of all cells. */
MatrixXd MakeContrasts(const std::vector<Factor>& factors, const std::vector<size_t>& effect) {
  MatrixXd contrasts = MatrixXd::Ones(1, 1);
  for (size_t i = 0; i < factors.size(); ++i) {
    const auto num_levels = static_cast<Eigen::Index>(factors[i].levels.size());
    const bool is_in_effect = std::find(effect.begin(), effect.end(), i) != effect.end();
    const MatrixXd own =
        is_in_effect
            ? MakeHelmert(num_levels)
            : MatrixXd::Constant(num_levels, 1, 1.0 / std::sqrt(static_cast<double>(num_levels)));
    contrasts = Eigen::kroneckerProduct(contrasts, own).eval();
  }
  return contrasts;
}

/** All non-empty sets of factors, small ones first, each in order. */
std::vector<std::vector<size_t>> ListEffects(size_t num_factors) {
  std::vector<std::vector<size_t>> effects;
  for (size_t set = 1; set < (size_t{1} << num_factors); ++set) {
    std::vector<size_t> effect;
    for (size_t i = 0; i < num_factors; ++i) {
      if (set & (size_t{1} << i)) effect.push_back(i);
    }
    effects.push_back(effect);
  }
  std::sort(effects.begin(), effects.end(), [](const auto& a, const auto& b) {
    return a.size() != b.size() ? a.size() < b.size() : a < b;
  });
  return effects;
}

Answer<MauchlyTest> CalcMauchly(const MatrixXd& covariance, int num_cells, int num_persons) {
  const int d = static_cast<int>(covariance.rows());
  if (d == 1) return NoAnswer{"two levels are always spherical"};
  if (num_persons <= d) {
    return NoAnswer{std::to_string(num_persons) + " persons are too few for " + std::to_string(d) +
                    " contrasts; expected " + std::to_string(d + 1) + " or more"};
  }
  // Scaled first, so that neither the determinant nor the power leaves the range of doubles.
  const double w = (covariance * (d / covariance.trace())).determinant();
  if (w <= std::numeric_limits<double>::epsilon()) {
    return NoAnswer{"the contrasts of all persons are linearly dependent"};
  }
  return MauchlyTest{w, CalcMauchlyP(std::min(w, 1.0), d, num_cells, num_persons)};
}

CorrectedF Correct(double f, double epsilon, double df_effect, double df_error) {
  CorrectedF corrected;
  corrected.epsilon = epsilon;
  corrected.df_effect = epsilon * df_effect;
  corrected.df_error = epsilon * df_error;
  corrected.p = CalcFisherUpperP(f, corrected.df_effect, corrected.df_error);
  return corrected;
}

/** @param num_persons  degrees of freedom of the covariance and one. */
Answer<WithinTest> CalcTest(const WithinEffect& effect, const MatrixXd& covariance, int num_cells,
                            int num_persons) {
  const int d = static_cast<int>(covariance.rows());
  WithinTest test;
  test.f = (effect.ss_effect / effect.df_effect) / (effect.ss_error / effect.df_error);
  test.p = CalcFisherUpperP(test.f, effect.df_effect, effect.df_error);
  const double epsilon =
      std::min(1.0, covariance.trace() * covariance.trace() / (d * covariance.squaredNorm()));
  test.greenhouse_geisser = Correct(test.f, epsilon, effect.df_effect, effect.df_error);
  const Answer<double> huynh_feldt = CalcHuynhFeldt(epsilon, d, num_persons);
  if (huynh_feldt) {
    test.huynh_feldt = Correct(test.f, *huynh_feldt, effect.df_effect, effect.df_error);
  } else {
    test.huynh_feldt = huynh_feldt.none();
  }
  test.mauchly = CalcMauchly(covariance, num_cells, num_persons);
  test.partial_eta_squared = effect.ss_effect / (effect.ss_effect + effect.ss_error);
  return test;
}

/** A combination of groups with fewer than two persons; empty: there is none. */
std::string FindPoorGroup(const CellMeans& cells) {
  if (cells.groups.empty()) return "";
  const std::vector<std::string> names = ListCells(cells.groups);
  std::vector<int> counts(names.size(), 0);
  for (const std::vector<size_t>& levels : cells.group_levels) {
    size_t group = 0;
    for (size_t i = 0; i < levels.size(); ++i) {
      group = group * cells.groups[i].levels.size() + levels[i];
    }
    ++counts[group];
  }
  for (size_t i = 0; i < names.size(); ++i) {
    if (counts[i] < 2) {
      return "group \"" + names[i] + "\" has " + FormatCount(counts[i], "person") +
             " with a value in every condition; expected 2 or more";
    }
  }
  return "";
}

/** Why there is nothing to compare. */
std::optional<NoAnswer> FindObstacle(const CellMeans& cells) {
  constexpr size_t kMaxFactors = 8;
  std::vector<Factor> factors = cells.factors;
  factors.insert(factors.end(), cells.groups.begin(), cells.groups.end());
  if (factors.empty()) return NoAnswer{"no factor: nothing to compare"};
  if (factors.size() > kMaxFactors) {
    return NoAnswer{std::to_string(factors.size()) + " factors; expected at most " +
                    std::to_string(kMaxFactors)};
  }
  for (const Factor& factor : factors) {
    if (factor.levels.size() < 2) {
      return NoAnswer{"factor \"" + factor.name + "\" has one level: nothing to compare"};
    }
  }
  const int num_persons = static_cast<int>(cells.means.rows());
  if (num_persons < 2) {
    return NoAnswer{FormatCount(num_persons, "person") + "; expected 2 or more"};
  }
  const std::string poor_group = FindPoorGroup(cells);
  if (!poor_group.empty()) return NoAnswer{poor_group};
  return std::nullopt;
}

/** The persons' groups as effect-coded columns, and which columns belong to which set of groups. */
class GroupDesign {
 public:
  explicit GroupDesign(const CellMeans& cells)
      : cells_(cells), x_(MatrixXd::Ones(cells.means.rows(), 1)) {
    columns_[{}] = {0, 1};
    for (const std::vector<size_t>& effect : ListEffects(cells.groups.size())) {
      const MatrixXd own = MakeColumns(effect);
      columns_[effect] = {x_.cols(), own.cols()};
      x_.conservativeResize(Eigen::NoChange, x_.cols() + own.cols());
      x_.rightCols(own.cols()) = own;
    }
    inverse_ = (x_.transpose() * x_).inverse();
  }

  int df_error() const { return static_cast<int>(x_.rows() - x_.cols()); }
  Eigen::Index num_columns(const std::vector<size_t>& effect) const {
    return columns_.at(effect).second;
  }
  MatrixXd CalcResiduals(const MatrixXd& scores) const {
    return scores - x_ * (inverse_ * (x_.transpose() * scores));
  }
  /** Sum of squares of type III. */
  double CalcSquares(const std::vector<size_t>& effect, const MatrixXd& scores) const {
    const auto [first, count] = columns_.at(effect);
    const MatrixXd own = (inverse_ * (x_.transpose() * scores)).middleRows(first, count);
    const MatrixXd inner = inverse_.block(first, first, count, count);
    return (own.transpose() * inner.inverse() * own).trace();
  }

 private:
  MatrixXd MakeColumns(const std::vector<size_t>& effect) const {
    MatrixXd columns = MatrixXd::Ones(x_.rows(), 1);
    for (const size_t group : effect) {
      const MatrixXd coding =
          MakeEffectCoding(static_cast<Eigen::Index>(cells_.groups[group].levels.size()));
      MatrixXd longer(x_.rows(), columns.cols() * coding.cols());
      for (Eigen::Index person = 0; person < x_.rows(); ++person) {
        const auto level =
            static_cast<Eigen::Index>(cells_.group_levels[static_cast<size_t>(person)][group]);
        longer.row(person) = Eigen::kroneckerProduct(columns.row(person), coding.row(level)).eval();
      }
      columns = longer;
    }
    return columns;
  }

  const CellMeans& cells_;
  MatrixXd x_, inverse_;
  std::map<std::vector<size_t>, std::pair<Eigen::Index, Eigen::Index>> columns_;
};

}  // namespace

Answer<double> CalcHuynhFeldt(double greenhouse_geisser, int num_contrasts, int num_persons) {
  if (num_contrasts == 1) return 1.0;
  const double used = num_contrasts * greenhouse_geisser;
  const double left = num_persons - 1.0 - used;
  if (left <= 1e-9 * num_persons) {
    return NoAnswer{std::to_string(num_persons) + " persons are too few for " +
                    std::to_string(num_contrasts) + " contrasts"};
  }
  // It is never below Greenhouse and Geisser's, but for rounding.
  return std::clamp((num_persons * used - 2.0) / (num_contrasts * left), greenhouse_geisser, 1.0);
}

double CalcMauchlyP(double w, int num_contrasts, int num_cells, int num_persons) {
  const double d = num_contrasts;
  const double df = num_persons - 1.0;
  const double rho = 1.0 - (2.0 * d * d + d + 2.0) / (6.0 * d * df);
  const double omega = (d + 2.0) * (d - 1.0) * (d - 2.0) *
                       (2.0 * d * d * d + 6.0 * d * d + 3.0 * num_cells + 2.0) /
                       (288.0 * d * d * df * df * rho * rho);
  const double chi_squared = std::max(0.0, -df * rho * std::log(w));
  const double shape_df = d * (d + 1.0) / 2.0 - 1.0;
  const double first = CalcChiSquaredUpperP(chi_squared, shape_df);
  const double second = CalcChiSquaredUpperP(chi_squared, shape_df + 4.0);
  return std::clamp(first + omega * (second - first), 0.0, 1.0);
}

Answer<WithinAnova> CalcWithinAnova(const CellMeans& cells) {
  if (const auto obstacle = FindObstacle(cells)) return *obstacle;
  const MatrixXd& y = cells.means;
  const int num_persons = static_cast<int>(y.rows());
  GRASPBENCH_DEMAND(y.cols() == static_cast<Eigen::Index>(ListCells(cells.factors).size()),
                    std::to_string(y.cols()) + " columns");

  // The common level carries no information but costs digits.
  const MatrixXd centred = y.array() - y.mean();
  const double rounding = 16.0 * std::numeric_limits<double>::epsilon() * y.cwiseAbs().maxCoeff();
  const double negligible = rounding * rounding * static_cast<double>(y.size());

  const GroupDesign design(cells);
  const size_t num_factors = cells.factors.size();
  WithinAnova anova;
  anova.num_persons = num_persons;
  anova.ss_person = design.CalcResiduals(centred * MakeContrasts(cells.factors, {})).squaredNorm();
  double ss_error_of_all = 0.0;
  for (const std::vector<size_t>& members : ListEffects(num_factors + cells.groups.size())) {
    WithinEffect effect;
    for (const size_t member : members) {
      const bool is_within = member < num_factors;
      (is_within ? effect.factors : effect.groups)
          .push_back(is_within ? member : member - num_factors);
      effect.name += (effect.name.empty() ? "" : " x ") +
                     (is_within ? cells.factors[member] : cells.groups[member - num_factors]).name;
    }
    const MatrixXd scores = centred * MakeContrasts(cells.factors, effect.factors);
    const MatrixXd residuals = design.CalcResiduals(scores);
    effect.ss_effect = design.CalcSquares(effect.groups, scores);
    effect.ss_error = residuals.squaredNorm();
    effect.df_effect = static_cast<double>(scores.cols() * design.num_columns(effect.groups));
    effect.df_error = static_cast<double>(scores.cols() * design.df_error());
    // The same contrasts with other groups have the same error.
    if (effect.groups.empty()) ss_error_of_all += effect.ss_error;
    if (effect.ss_error <= negligible) {
      effect.test = NoAnswer{"the effect is the same in all " + std::to_string(num_persons) +
                             " persons: no spread to test against"};
    } else {
      effect.test = CalcTest(effect, residuals.transpose() * residuals / design.df_error(),
                             static_cast<int>(y.cols()), design.df_error() + 1);
    }
    anova.effects.push_back(std::move(effect));
  }
  for (WithinEffect& effect : anova.effects) {
    if (!effect.test) continue;
    WithinTest test = *effect.test;
    test.generalised_eta_squared =
        effect.ss_effect / (effect.ss_effect + anova.ss_person + ss_error_of_all);
    effect.test = std::move(test);
  }
  return anova;
}

Answer<OneWayAnova> CalcMeanSquares(const std::vector<std::vector<double>>& groups) {
  OneWayAnova anova;
  std::vector<double> all;
  for (const std::vector<double>& group : groups) {
    if (group.empty()) continue;
    ++anova.num_groups;
    all.insert(all.end(), group.begin(), group.end());
  }
  if (!std::all_of(all.begin(), all.end(), [](double value) { return std::isfinite(value); })) {
    return NoAnswer{"a value is not finite"};
  }
  if (anova.num_groups < 2) {
    return NoAnswer{FormatCount(anova.num_groups, "group") + "; expected 2 or more"};
  }
  anova.num_values = static_cast<int>(all.size());
  anova.df_between = anova.num_groups - 1.0;
  anova.df_within = anova.num_values - anova.num_groups;
  if (anova.df_within == 0.0) return NoAnswer{"every group has a single value: no spread within"};

  const Moments all_moments = CalcMoments(all);
  bool is_constant = true;
  for (const std::vector<double>& group : groups) {
    if (group.empty()) continue;
    const Moments moments = CalcMoments(group);
    const double deviation = moments.mean - all_moments.mean;
    anova.ss_between += static_cast<double>(group.size()) * deviation * deviation;
    anova.ss_within += moments.sum_of_squares;
    is_constant = is_constant && moments.is_constant;
  }
  if (is_constant) return NoAnswer{"the values of every group are equal: no spread within"};
  anova.ms_between = anova.ss_between / anova.df_between;
  anova.ms_within = anova.ss_within / anova.df_within;
  anova.f = anova.ms_between / anova.ms_within;
  return anova;
}

Answer<OneWayAnova> CalcOneWayAnova(const std::vector<std::vector<double>>& groups) {
  const Answer<OneWayAnova> mean_squares = CalcMeanSquares(groups);
  if (!mean_squares) return mean_squares.none();
  OneWayAnova anova = *mean_squares;
  anova.p = CalcFisherUpperP(anova.f, anova.df_between, anova.df_within);
  return anova;
}

}  // namespace graspbench
