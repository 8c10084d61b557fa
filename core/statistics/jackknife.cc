#include "core/statistics/jackknife.h"

#include <cmath>
#include <numeric>

#include "core/statistics/distributions.h"
#include "core/statistics/summary.h"

namespace graspbench {

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
    return NoAnswer{"the statistic does not depend on who is drawn"};
  }
  return values;
}

Answer<JackknifeInterval> CalcJackknife(size_t num_members, const GroupStatistic& statistic) {
  constexpr size_t kMinMembers = 3;
  if (num_members < kMinMembers) {
    return NoAnswer{std::to_string(num_members) + " to leave out; expected " +
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
