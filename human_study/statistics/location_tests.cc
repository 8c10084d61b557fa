#include "human_study/statistics/location_tests.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/base/text/text.h"
#include "core/statistics/distributions.h"
#include "core/statistics/ranks.h"
#include "core/statistics/summary.h"
#include "human_study/statistics/measure_table.h"

namespace graspbench {

namespace {

Answer<TTest> CalcTest(const std::vector<double>& all_values, double reference, double scale) {
  std::vector<double> values;
  for (double value : all_values) {
    if (std::string fault = FindUnusable(value); !fault.empty()) return NoAnswer{fault};
    if (!std::isnan(value)) values.push_back(value);
  }
  if (values.size() < 2) {
    return NoAnswer{FormatCount(values.size(), "person") + " with a value; expected 2 or more"};
  }
  const Moments moments = CalcMoments(values, scale);
  if (moments.is_constant) {
    return NoAnswer{"all " + std::to_string(values.size()) +
                    " values are equal: no spread to test against"};
  }
  TTest test;
  test.count = static_cast<int>(values.size());
  test.num_missing = static_cast<int>(all_values.size() - values.size());
  test.mean = moments.mean;
  test.df = test.count - 1.0;
  test.standard_deviation = std::sqrt(moments.sum_of_squares / test.df);
  test.reference = reference;
  test.d_z = (test.mean - reference) / test.standard_deviation;
  const double standard_error = test.standard_deviation / std::sqrt(test.count);
  test.t = (test.mean - reference) / standard_error;
  test.p = CalcStudentTwoSidedP(test.t, test.df);
  const double half_width = CalcStudentQuantile(0.975, test.df) * standard_error;
  test.interval = {test.mean - half_width, test.mean + half_width};
  return test;
}

}  // namespace

Answer<TTest> CalcTTest(const std::vector<double>& values, double reference) {
  return CalcTest(values, reference, 0.0);
}

Answer<TTest> CalcPairedTTest(const std::vector<double>& a, const std::vector<double>& b) {
  GRASPBENCH_DEMAND(a.size() == b.size(),
                    std::to_string(a.size()) + " and " + std::to_string(b.size()));
  std::vector<double> differences;
  double scale = 0.0;
  for (size_t i = 0; i < a.size(); ++i) {
    if (std::isinf(a[i]) || std::isinf(b[i])) return NoAnswer{"a value is infinite"};
    differences.push_back(a[i] - b[i]);
    if (!std::isnan(differences.back())) scale = std::max({scale, std::abs(a[i]), std::abs(b[i])});
  }
  return CalcTest(differences, 0.0, scale);
}

Answer<WelchTest> CalcWelchTest(const std::vector<double>& a, const std::vector<double>& b) {
  // Each group's own mean and spread; the reference does not matter.
  double scale = 0.0;
  for (const auto* values : {&a, &b}) {
    for (const double value : *values) scale = std::fmax(scale, std::abs(value));
  }
  std::vector<double> present[2];
  for (int i = 0; i < 2; ++i) {
    for (const double value : i == 0 ? a : b) {
      if (std::isinf(value)) return NoAnswer{"a value is infinite"};
      if (!std::isnan(value)) present[i].push_back(value);
    }
    if (present[i].size() < 2) {
      return NoAnswer{FormatCount(present[i].size(), "person") +
                      " with a value in a group; expected 2 or more"};
    }
  }
  const Moments first = CalcMoments(present[0], scale), second = CalcMoments(present[1], scale);
  if (first.is_constant && second.is_constant) {
    return NoAnswer{"the values within both groups are equal: no spread to test against"};
  }
  const auto n_a = static_cast<double>(present[0].size());
  const auto n_b = static_cast<double>(present[1].size());
  const double error_a = first.sum_of_squares / (n_a - 1.0) / n_a;
  const double error_b = second.sum_of_squares / (n_b - 1.0) / n_b;
  WelchTest test;
  test.count_a = static_cast<int>(present[0].size());
  test.count_b = static_cast<int>(present[1].size());
  test.difference = first.mean - second.mean;
  test.standard_error = std::sqrt(error_a + error_b);
  test.t = test.difference / test.standard_error;
  test.df = (error_a + error_b) * (error_a + error_b) /
            (error_a * error_a / (n_a - 1.0) + error_b * error_b / (n_b - 1.0));
  test.p = CalcStudentTwoSidedP(test.t, test.df);
  const double half_width = CalcStudentQuantile(0.975, test.df) * test.standard_error;
  test.interval = {test.difference - half_width, test.difference + half_width};
  test.d_s = test.difference /
             std::sqrt((first.sum_of_squares + second.sum_of_squares) / (n_a + n_b - 2.0));
  return test;
}

Answer<EquivalenceTest> CalcEquivalence(const Answer<TTest>& test, Interval bounds) {
  if (!test) return test.none();
  if (!(bounds.low < bounds.high)) return NoAnswer{"the lower bound is not below the upper one"};
  const double standard_error = test->standard_deviation / std::sqrt(test->count);
  EquivalenceTest result;
  result.bounds = bounds;
  result.t_low = (test->mean - bounds.low) / standard_error;
  result.t_high = (test->mean - bounds.high) / standard_error;
  result.p_low = CalcStudentUpperP(result.t_low, test->df);
  result.p_high = CalcStudentUpperP(-result.t_high, test->df);
  result.p = std::max(result.p_low, result.p_high);
  const double half_width = CalcStudentQuantile(0.95, test->df) * standard_error;
  result.interval = {test->mean - half_width, test->mean + half_width};
  return result;
}

namespace {

constexpr double kRounding = 8.0 * std::numeric_limits<double>::epsilon();

/** P(sum of the chosen <= limit), each value chosen with probability 1/2. */
double CalcSubsetSumP(const std::vector<int>& values, int limit) {
  std::vector<double> p(static_cast<size_t>(limit) + 1, 0.0);
  p[0] = 1.0;
  for (int value : values) {
    for (int sum = limit; sum >= 0; --sum) {
      const double with = sum >= value ? p[static_cast<size_t>(sum - value)] : 0.0;
      p[static_cast<size_t>(sum)] = 0.5 * (p[static_cast<size_t>(sum)] + with);
    }
  }
  return std::accumulate(p.begin(), p.end(), 0.0);
}

}  // namespace

Answer<WilcoxonTest> CalcWilcoxon(const std::vector<double>& a, const std::vector<double>& b) {
  GRASPBENCH_DEMAND(a.size() == b.size(),
                    std::to_string(a.size()) + " and " + std::to_string(b.size()));
  constexpr size_t kMaxPairs = 1000;  // the exact distribution costs the cube of it
  double scale = 0.0;
  for (size_t i = 0; i < a.size(); ++i) {
    if (std::isinf(a[i]) || std::isinf(b[i])) return NoAnswer{"a value is infinite"};
    if (!std::isnan(a[i] - b[i])) scale = std::max({scale, std::abs(a[i]), std::abs(b[i])});
  }
  const double tolerance = kRounding * scale;
  WilcoxonTest test;
  std::vector<double> sizes;
  std::vector<bool> is_positive;
  for (size_t i = 0; i < a.size(); ++i) {
    const double difference = a[i] - b[i];
    if (std::isnan(difference)) {
      ++test.num_missing;
    } else if (std::abs(difference) <= tolerance) {
      ++test.num_zeros;
    } else {
      sizes.push_back(std::abs(difference));
      is_positive.push_back(difference > 0.0);
    }
  }
  if (sizes.empty()) {
    return NoAnswer{"none of " + std::to_string(a.size()) + " pairs has a difference"};
  }
  if (sizes.size() > kMaxPairs) {
    return NoAnswer{std::to_string(sizes.size()) + " pairs; expected at most " +
                    std::to_string(kMaxPairs)};
  }
  const Ranks ranks = RankValues(sizes, tolerance);
  int twice_plus = 0, twice_minus = 0;
  for (size_t i = 0; i < sizes.size(); ++i) {
    (is_positive[i] ? twice_plus : twice_minus) += ranks.twice[i];
  }
  test.count = static_cast<int>(sizes.size());
  test.has_ties = ranks.tie_sum > 0.0;
  test.w_plus = 0.5 * twice_plus;
  test.w_minus = 0.5 * twice_minus;
  test.rank_biserial = (test.w_plus - test.w_minus) / (test.w_plus + test.w_minus);
  test.p = std::min(1.0, 2.0 * CalcSubsetSumP(ranks.twice, std::min(twice_plus, twice_minus)));
  return test;
}

Answer<FriedmanTest> CalcFriedman(const CellMeans& cells) {
  const double n = static_cast<double>(cells.means.rows());
  const double k = static_cast<double>(cells.means.cols());
  if (n < 2) return NoAnswer{FormatCount(cells.means.rows(), "person") + "; expected 2 or more"};
  if (k < 2) return NoAnswer{"one condition: nothing to compare"};
  FriedmanTest test;
  test.num_persons = static_cast<int>(n);
  test.mean_ranks.assign(static_cast<size_t>(k), 0.0);
  double tie_sum = 0.0;
  for (Eigen::Index p = 0; p < cells.means.rows(); ++p) {
    const auto row = cells.means.row(p);
    const Ranks ranks = RankValues({row.begin(), row.end()}, kRounding * row.cwiseAbs().maxCoeff());
    tie_sum += ranks.tie_sum;
    for (size_t c = 0; c < ranks.twice.size(); ++c) test.mean_ranks[c] += 0.5 * ranks.twice[c] / n;
  }
  const double untied_share = 1.0 - tie_sum / (n * k * (k * k - 1.0));
  if (untied_share <= 0.0) return NoAnswer{"no person has different values: all are tied"};
  double spread = 0.0;
  for (double rank : test.mean_ranks) spread += (rank - (k + 1.0) / 2.0) * (rank - (k + 1.0) / 2.0);
  test.chi_squared = 12.0 * n * spread / (k * (k + 1.0)) / untied_share;
  test.df = k - 1.0;
  test.p = CalcChiSquaredUpperP(test.chi_squared, test.df);
  test.kendall_w = test.chi_squared / (n * test.df);
  return test;
}

}  // namespace graspbench
