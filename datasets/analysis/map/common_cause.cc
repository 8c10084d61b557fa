#include "datasets/analysis/map/common_cause.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/enum_table.h"
#include "core/base/text/text.h"
#include "core/statistics/ranks.h"
#include "core/statistics/summary.h"

namespace graspbench {
namespace {

constexpr int kNumCauseResamples = 1999;
constexpr double kRounding = 1e-9;  // share of a variable, or of a variance, that is rounding

struct CauseRow {
  const char* name;
  double MapTrial::*size;
};
constexpr CauseRow kCauses[] = {{"the object's offset", &MapTrial::offset},
                                {"the object's turn", &MapTrial::turn}};
/** Success, rank of GFT, then the causes. */
constexpr int kNumVariables = 2 + static_cast<int>(std::size(kCauses));
/** Sums of products. */
using Products = Eigen::Matrix<double, kNumVariables, kNumVariables>;

struct ObjectProducts {
  Products products = Products::Zero();
  int num_trials = 0;
};

std::vector<const MapTrial*> ListUndelayed(const MapData& data, const std::string& hand) {
  std::vector<const MapTrial*> trials;
  for (const MapTrial& trial : data.trials) {
    const double success = trial.values[static_cast<size_t>(MapMeasure::kSuccess)];
    if (trial.hand != hand || trial.late != LateDigit::kNone) continue;
    if (std::isnan(success) || std::isnan(trial.first_to_last)) continue;
    trials.push_back(&trial);
  }
  return trials;
}

/** Columns: one for each object, then one for each level but the first of every factor that does
not scale the draws. */
Eigen::MatrixXd MakeIndicators(const MapData& data, const std::vector<const MapTrial*>& trials,
                               const std::vector<std::string>& objects) {
  size_t num_columns = objects.size();
  std::vector<size_t> first_column;
  for (const MapFactor& factor : data.factors) {
    first_column.push_back(num_columns);
    if (!factor.scales_draws) num_columns += factor.levels.size() - 1;
  }
  Eigen::MatrixXd indicators = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(trials.size()),
                                                     static_cast<Eigen::Index>(num_columns));
  for (size_t i = 0; i < trials.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    const auto object = std::find(objects.begin(), objects.end(), trials[i]->object);
    indicators(row, object - objects.begin()) = 1.0;
    for (size_t k = 0; k < data.factors.size(); ++k) {
      const size_t level = trials[i]->levels[k];
      if (data.factors[k].scales_draws || level == 0) continue;
      indicators(row, static_cast<Eigen::Index>(first_column[k] + level - 1)) = 1.0;
    }
  }
  return indicators;
}

/** A row for each trial: success, rank of GFT, then the causes. */
Eigen::MatrixXd MakeVariables(const std::vector<const MapTrial*>& trials) {
  std::vector<double> times;
  for (const MapTrial* trial : trials) {
    times.push_back(std::isinf(trial->first_to_last) ? std::numeric_limits<double>::max()
                                                     : trial->first_to_last);
  }
  const std::vector<int> ranks = RankValues(times).twice;
  Eigen::MatrixXd variables(static_cast<Eigen::Index>(trials.size()), kNumVariables);
  for (size_t i = 0; i < trials.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    variables(row, 0) = trials[i]->values[static_cast<size_t>(MapMeasure::kSuccess)];
    variables(row, 1) = ranks[i];
    for (size_t k = 0; k < std::size(kCauses); ++k) {
      const double size = trials[i]->*kCauses[k].size;
      variables(row, static_cast<Eigen::Index>(2 + k)) = std::isnan(size) ? 0.0 : size;
    }
  }
  return variables;
}

/** By object, of what objects and levels leave. */
std::vector<ObjectProducts> SumProducts(const MapData& data,
                                        const std::vector<const MapTrial*>& trials) {
  std::vector<std::string> objects;
  for (const MapTrial* trial : trials) {
    if (std::find(objects.begin(), objects.end(), trial->object) == objects.end()) {
      objects.push_back(trial->object);
    }
  }
  const Eigen::MatrixXd indicators = MakeIndicators(data, trials, objects);
  const Eigen::MatrixXd variables = MakeVariables(trials);
  // Levels that never occur leave columns of zeros, so the rank may be short.
  Eigen::MatrixXd rest =
      variables - indicators * indicators.completeOrthogonalDecomposition().solve(variables);
  for (Eigen::Index k = 0; k < rest.cols(); ++k) {  // rounding would correlate with itself
    const double least = kRounding * variables.col(k).cwiseAbs().maxCoeff();
    for (double& value : rest.col(k)) value = std::abs(value) > least ? value : 0.0;
  }
  std::vector<ObjectProducts> sums(objects.size());
  for (size_t i = 0; i < trials.size(); ++i) {
    const auto object = std::find(objects.begin(), objects.end(), trials[i]->object);
    ObjectProducts& sum = sums[static_cast<size_t>(object - objects.begin())];
    const Eigen::RowVectorXd one = rest.row(static_cast<Eigen::Index>(i));
    sum.products += one.transpose() * one;
    ++sum.num_trials;
  }
  return sums;
}

double CalcCorrelation(const Products& sums, int a, int b) {
  const double squares = sums(a, a) * sums(b, b);
  return squares > 0.0 ? sums(a, b) / std::sqrt(squares) : 0.0;
}

/** Of success and times, with one variable held; 0: none is. */
double CalcPartial(const std::vector<ObjectProducts>& objects, const std::vector<size_t>& members,
                   int held) {
  Products sums = Products::Zero();
  for (const size_t member : members) sums += objects[member].products;
  const double r = CalcCorrelation(sums, 0, 1);
  if (held == 0) return r;
  const double with_success = CalcCorrelation(sums, 0, held);
  const double with_times = CalcCorrelation(sums, 1, held);
  const double rest = (1.0 - with_success * with_success) * (1.0 - with_times * with_times);
  if (rest < kRounding) return 0.0;
  return std::clamp((r - with_success * with_times) / std::sqrt(rest), -1.0, 1.0);
}

bool ExcludesZero(const Interval& interval) { return interval.low > 0.0 || interval.high < 0.0; }

}  // namespace

Answer<NaturalRelation> FindNaturalRelation(const MapData& data, const std::string& hand) {
  const std::vector<const MapTrial*> trials = ListUndelayed(data, hand);
  if (trials.empty()) return NoAnswer{"no trial without delay whose times are known"};
  const std::vector<ObjectProducts> objects = SumProducts(data, trials);
  NaturalRelation relation;
  relation.num_objects = static_cast<int>(objects.size());
  for (const ObjectProducts& object : objects) relation.num_trials += object.num_trials;
  const auto draw = [&](int held) {
    return CalcBootstrap(
        objects.size(),
        [&](const std::vector<size_t>& members) { return CalcPartial(objects, members, held); },
        "natural relation " + hand + " " + std::to_string(held), kNumCauseResamples);
  };
  const Answer<BootstrapInterval> whole = draw(0);
  if (!whole) return whole.none();
  relation.correlation = whole->estimate;
  relation.interval = whole->interval;
  double least = 0.5 * std::abs(relation.correlation);
  for (size_t k = 0; k < std::size(kCauses); ++k) {
    const Answer<BootstrapInterval> partial = draw(2 + static_cast<int>(k));
    if (!partial) continue;
    relation.causes.push_back({kCauses[k].name, partial->estimate, partial->interval});
    if (!ExcludesZero(relation.interval) || std::abs(partial->estimate) >= least) continue;
    least = std::abs(partial->estimate);
    relation.cause = kCauses[k].name;
  }
  return relation;
}

MapFinding FindWhatMatters(const SimultaneityMap& map, const Answer<NaturalRelation>& natural,
                           const std::string& hand) {
  const MapCell* const whole = FindCell(map, MapMeasure::kSuccess, hand, LateDigit::kLast, {});
  const bool is_none =
      whole && (whole->verdict == MapVerdict::kNone || whole->verdict == MapVerdict::kCeiling);
  for (const MapCell& cell : map.cells) {
    if (cell.hand != hand || cell.measure != MapMeasure::kSuccess ||
        cell.late != LateDigit::kLast) {
      continue;
    }
    if (cell.verdict == MapVerdict::kCosts || cell.verdict == MapVerdict::kGains) {
      return MapFinding::kMatters;
    }
  }
  if (!is_none) return MapFinding::kUndecided;
  const bool has_cause = natural && natural->interval.high < 0.0 && !natural->cause.empty();
  return has_cause ? MapFinding::kCommonCause : MapFinding::kNoEffect;
}

std::string DescribeFinding(const SimultaneityMap& map, const Answer<NaturalRelation>& natural,
                            const std::string& hand) {
  const MapFinding finding = FindWhatMatters(map, natural, hand);
  const MapCell* const whole = FindCell(map, MapMeasure::kSuccess, hand, LateDigit::kLast, {});
  std::string text = hand + ": " + RowOf(kMapFindings, finding).name +
                     ". By delays of the last "
                     "digit on the same draws, success changes by " +
                     (whole ? FormatEffect(*whole) : std::string("n/a")) +
                     " points for 100 ms over all regions";
  if (!natural) return text + "; in trials without delay not testable: " + natural.reason() + ".";
  text += "; in trials without delay the correlation of late digits with success is " +
          FormatFixed(natural->correlation, 2) + " (" + FormatFixed(natural->interval.low, 2) +
          " to " + FormatFixed(natural->interval.high, 2) + ")";
  if (natural->cause.empty()) {
    return text + (ExcludesZero(natural->interval)
                       ? "; no recorded variable explains this correlation."
                       : ".");
  }
  return text + ", mostly explained by " + natural->cause + ".";
}

}  // namespace graspbench
