#include "core/statistics/bootstrap.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/base/random.h"
#include "core/statistics/distributions.h"
#include "core/statistics/summary.h"

namespace graspbench {

namespace {

/** Values of the statistic without each member in turn. No answer when one of them is undefined or
when they do not vary. */
Answer<std::vector<double>> LeaveOneOut(size_t num_members, const GroupStatistic& statistic) {
  std::vector<double> values;
  for (size_t left_out = 0; left_out < num_members; ++left_out) {
    std::vector<size_t> members;
    for (size_t i = 0; i < num_members; ++i) {
      if (i != left_out) members.push_back(i);
    }
    values.push_back(statistic(members));
    if (!std::isfinite(values.back())) {
      return NoAnswer{"the statistic has no value without member " + std::to_string(left_out + 1)};
    }
  }
  if (values.empty() || CalcMoments(values).is_constant) {
    return NoAnswer{"the statistic is the same for every resample"};
  }
  return values;
}

/** Efron's a: skewness of the jackknife values over 6. No answer when they do not vary. */
Answer<double> CalcAcceleration(size_t num_members, const GroupStatistic& statistic) {
  const Answer<std::vector<double>> values = LeaveOneOut(num_members, statistic);
  if (!values) return values.none();
  const Moments moments = CalcMoments(*values);
  double cubes = 0.0;
  for (double value : *values) cubes += std::pow(moments.mean - value, 3);
  return cubes / (6.0 * std::pow(moments.sum_of_squares, 1.5));
}

}  // namespace

Answer<BootstrapInterval> CalcBootstrap(size_t num_members, const GroupStatistic& statistic,
                                        const std::string& id, int num_resamples) {
  GRASPBENCH_DEMAND(num_resamples >= 100, std::to_string(num_resamples));
  constexpr size_t kMinMembers = 5;
  if (num_members < kMinMembers) {
    return NoAnswer{std::to_string(num_members) + " to resample; an interval needs " +
                    std::to_string(kMinMembers) + " or more"};
  }
  std::vector<size_t> members(num_members);
  std::iota(members.begin(), members.end(), size_t{0});
  BootstrapInterval result;
  result.estimate = statistic(members);
  if (!std::isfinite(result.estimate)) return NoAnswer{"the statistic has no value"};
  result.num_resamples = num_resamples;
  const Answer<double> acceleration = CalcAcceleration(num_members, statistic);
  if (!acceleration) return acceleration.none();
  result.acceleration = *acceleration;

  RandomStream random(id, "bootstrap");
  std::vector<double> values;
  double num_below = 0.0;
  for (int k = 0; k < num_resamples; ++k) {
    for (size_t& member : members) {
      member = static_cast<size_t>(random.NextIndex(static_cast<int>(num_members)));
    }
    const double value = statistic(members);
    if (!std::isfinite(value)) return NoAnswer{"the statistic has no value for some resamples"};
    values.push_back(value);
    num_below += value < result.estimate ? 1.0 : value == result.estimate ? 0.5 : 0.0;
  }
  const double share = num_below / num_resamples;
  if (share <= 0.0 || share >= 1.0) {
    return NoAnswer{"all resamples lie on one side of the estimate"};
  }
  result.bias_correction = CalcNormalQuantile(share);
  std::sort(values.begin(), values.end());
  const auto find_limit = [&](double probability) {
    const double z = result.bias_correction + CalcNormalQuantile(probability);
    return CalcSortedQuantile(
        values, CalcNormalP(result.bias_correction + z / (1.0 - result.acceleration * z)));
  };
  result.interval = {find_limit(0.025), find_limit(0.975)};
  return result;
}

Answer<JackknifeInterval> CalcJackknife(size_t num_members, const GroupStatistic& statistic) {
  constexpr size_t kMinMembers = 3;
  if (num_members < kMinMembers) {
    return NoAnswer{std::to_string(num_members) + " to leave out; an interval needs " +
                    std::to_string(kMinMembers) + " or more"};
  }
  std::vector<size_t> all(num_members);
  std::iota(all.begin(), all.end(), size_t{0});
  JackknifeInterval result;
  result.estimate = statistic(all);
  if (!std::isfinite(result.estimate)) return NoAnswer{"the statistic has no value"};
  const Answer<std::vector<double>> values = LeaveOneOut(num_members, statistic);
  if (!values) return values.none();
  const double n = static_cast<double>(num_members);
  result.standard_error = std::sqrt((n - 1.0) / n * CalcMoments(*values).sum_of_squares);
  const double half_width = CalcStudentQuantile(0.975, n - 1.0) * result.standard_error;
  result.interval = {result.estimate - half_width, result.estimate + half_width};
  result.p = CalcStudentTwoSidedP(result.estimate / result.standard_error, n - 1.0);
  return result;
}

}  // namespace graspbench
