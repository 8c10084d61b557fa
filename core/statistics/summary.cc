#include "core/statistics/summary.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace graspbench {

double CalcMean(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value;
  return values.empty() ? std::numeric_limits<double>::quiet_NaN()
                        : sum / static_cast<double>(values.size());
}

Moments CalcMoments(const std::vector<double>& values, double scale) {
  GRASPBENCH_DEMAND(!values.empty(), "no values");
  const double count = static_cast<double>(values.size());
  double sum = 0.0;
  for (double value : values) {
    sum += value;
    scale = std::max(scale, std::abs(value));
  }
  Moments moments;
  moments.mean = sum / count;
  double rest = 0.0;
  for (double value : values) rest += value - moments.mean;
  moments.mean += rest / count;
  double sum_left = 0.0, sum_of_squares = 0.0;
  for (double value : values) {
    const double deviation = value - moments.mean;
    sum_left += deviation;
    sum_of_squares += deviation * deviation;
  }
  moments.sum_of_squares = std::max(0.0, sum_of_squares - sum_left * sum_left / count);
  constexpr double kRounding = 8.0 * std::numeric_limits<double>::epsilon();
  moments.is_constant = std::sqrt(moments.sum_of_squares / count) <= kRounding * scale;
  return moments;
}

double CalcMedian(std::vector<double> values) {
  if (values.empty()) return std::nan("");
  // Only the two middle values are needed; sorting all of them would dominate an analysis.
  const auto above = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), above, values.end());
  if (values.size() % 2 == 1) return *above;
  const double below = *std::max_element(values.begin(), above);
  // Equal values may be infinite, and inf - inf is not a number.
  return below == *above ? below : below + 0.5 * (*above - below);
}

double CalcMedianOfFinite(std::vector<double> values) {
  values.erase(std::remove_if(values.begin(), values.end(),
                              [](double value) { return !std::isfinite(value); }),
               values.end());
  return CalcMedian(std::move(values));
}

double CalcSortedQuantile(const std::vector<double>& sorted, double probability) {
  const double position = probability * static_cast<double>(sorted.size() - 1);
  const size_t below = static_cast<size_t>(position);
  const size_t above = std::min(below + 1, sorted.size() - 1);
  return sorted[below] + (position - static_cast<double>(below)) * (sorted[above] - sorted[below]);
}

Answer<Summary> CalcSummary(const std::vector<double>& values) {
  std::vector<double> sorted;
  for (double value : values) {
    if (std::isinf(value)) return NoAnswer{"a value is infinite"};
    if (!std::isnan(value)) sorted.push_back(value);
  }
  if (sorted.empty()) return NoAnswer{"no values"};
  const Moments moments = CalcMoments(sorted);
  std::sort(sorted.begin(), sorted.end());
  Summary summary;
  summary.count = static_cast<int>(sorted.size());
  summary.num_missing = static_cast<int>(values.size() - sorted.size());
  summary.mean = moments.mean;
  if (summary.count > 1) {
    summary.standard_deviation = std::sqrt(moments.sum_of_squares / (summary.count - 1));
  }
  summary.minimum = sorted.front();
  summary.lower_quartile = CalcSortedQuantile(sorted, 0.25);
  summary.median = CalcSortedQuantile(sorted, 0.5);
  summary.upper_quartile = CalcSortedQuantile(sorted, 0.75);
  summary.maximum = sorted.back();
  return summary;
}

}  // namespace graspbench
