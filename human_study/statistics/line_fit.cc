#include "human_study/statistics/line_fit.h"

#include <cmath>
#include <map>

#include "core/base/text/text.h"
#include "core/statistics/summary.h"

namespace graspbench {

Answer<LineFit> FitLine(const std::vector<double>& x, const std::vector<double>& y) {
  GRASPBENCH_DEMAND(x.size() == y.size(),
                    std::to_string(x.size()) + " and " + std::to_string(y.size()));
  for (size_t i = 0; i < x.size(); ++i) {
    if (!std::isfinite(x[i]) || !std::isfinite(y[i])) return NoAnswer{"a value is not finite"};
  }
  if (x.size() < 2) {
    return NoAnswer{FormatCount(x.size(), "point") + "; expected 2 or more"};
  }
  const Moments x_moments = CalcMoments(x), y_moments = CalcMoments(y);
  if (x_moments.is_constant) {
    return NoAnswer{"all " + std::to_string(x.size()) + " points have the same x"};
  }
  double product = 0.0;
  for (size_t i = 0; i < x.size(); ++i) {
    product += (x[i] - x_moments.mean) * (y[i] - y_moments.mean);
  }
  LineFit fit;
  fit.count = static_cast<int>(x.size());
  fit.slope = product / x_moments.sum_of_squares;
  fit.intercept = y_moments.mean - fit.slope * x_moments.mean;
  double residual_sum = 0.0;
  for (size_t i = 0; i < x.size(); ++i) {
    const double residual = y[i] - y_moments.mean - fit.slope * (x[i] - x_moments.mean);
    residual_sum += residual * residual;
  }
  if (fit.count > 2) {
    const double sd = std::sqrt(residual_sum / (fit.count - 2));
    fit.residual_sd = sd;
    fit.slope_error = sd / std::sqrt(x_moments.sum_of_squares);
    fit.intercept_error = sd * std::sqrt(1.0 / fit.count + x_moments.mean * x_moments.mean /
                                                               x_moments.sum_of_squares);
  }
  if (!y_moments.is_constant) fit.r_squared = 1.0 - residual_sum / y_moments.sum_of_squares;
  return fit;
}

Answer<std::vector<PersonPoint>> ListPoints(const MeasureTable& table, size_t factor_index) {
  GRASPBENCH_DEMAND(factor_index < table.factors.size(), std::to_string(factor_index));
  const Factor& factor = table.factors[factor_index];
  if (factor.numbers.empty()) {
    return NoAnswer{"the levels of factor \"" + factor.name + "\" have no numbers"};
  }
  std::vector<PersonPoint> points;
  for (const Observation& row : table.rows) {
    const Answer<size_t> cell = FindCell(table.factors, row);
    if (!cell) return cell.none();
    if (std::string fault = FindUnusable(row.value); !fault.empty()) return NoAnswer{fault};
    if (std::isnan(row.value)) continue;
    size_t stride = 1;
    for (size_t i = factor_index + 1; i < table.factors.size(); ++i) {
      stride *= table.factors[i].levels.size();
    }
    points.push_back(
        {row.person, factor.numbers[*cell / stride % factor.levels.size()], row.value});
  }
  return points;
}

PersonSlopes CalcPersonSlopes(const std::vector<PersonPoint>& points, double reference) {
  std::vector<std::string> persons;
  std::map<std::string, std::pair<std::vector<double>, std::vector<double>>> columns;
  for (const PersonPoint& point : points) {
    const auto [entry, is_new] = columns.try_emplace(point.person);
    if (is_new) persons.push_back(point.person);
    entry->second.first.push_back(point.x);
    entry->second.second.push_back(point.y);
  }
  PersonSlopes result;
  std::vector<double> slopes;
  for (const std::string& person : persons) {
    const auto& [x, y] = columns.at(person);
    result.persons.push_back({person, FitLine(x, y)});
    if (result.persons.back().line) slopes.push_back(result.persons.back().line->slope);
  }
  result.test = CalcTTest(slopes, reference);
  return result;
}

}  // namespace graspbench
