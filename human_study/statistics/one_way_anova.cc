#include "human_study/statistics/one_way_anova.h"

#include <algorithm>
#include <cmath>

#include "core/base/text/text.h"
#include "core/statistics/distributions.h"
#include "core/statistics/summary.h"

namespace graspbench {

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
