#include "human_study/statistics/t_tests.h"

#include <algorithm>
#include <cmath>

#include "core/base/text/text.h"
#include "core/statistics/distributions.h"
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

}  // namespace graspbench
