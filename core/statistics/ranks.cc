#include "core/statistics/ranks.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace graspbench {
namespace {

bool HasNan(const std::vector<double>& values) {
  return std::any_of(values.begin(), values.end(), [](double value) { return std::isnan(value); });
}

}  // namespace

Ranks RankValues(const std::vector<double>& values, double tolerance) {
  std::vector<size_t> order(values.size());
  std::iota(order.begin(), order.end(), size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](size_t a, size_t b) { return values[a] < values[b]; });
  Ranks ranks;
  ranks.twice.resize(values.size());
  for (size_t first = 0, last; first < order.size(); first = last) {
    last = first + 1;
    while (last < order.size() && values[order[last]] - values[order[last - 1]] <= tolerance) {
      ++last;
    }
    for (size_t i = first; i < last; ++i) {
      ranks.twice[order[i]] = static_cast<int>(first + last + 1);
    }
    const double count = static_cast<double>(last - first);
    ranks.tie_sum += count * count * count - count;
  }
  return ranks;
}

Answer<double> CalcSpearman(const std::vector<double>& a, const std::vector<double>& b) {
  GRASPBENCH_DEMAND(a.size() == b.size(),
                    std::to_string(a.size()) + " and " + std::to_string(b.size()));
  if (a.size() < 3) return NoAnswer{std::to_string(a.size()) + " pairs; expected 3 or more"};
  if (HasNan(a) || HasNan(b)) return NoAnswer{"a value is missing"};
  const Ranks ranks_a = RankValues(a), ranks_b = RankValues(b);
  const double mean = static_cast<double>(a.size()) + 1.0;  // of twice the ranks
  double ab = 0.0, aa = 0.0, bb = 0.0;
  for (size_t i = 0; i < a.size(); ++i) {
    const double da = ranks_a.twice[i] - mean, db = ranks_b.twice[i] - mean;
    ab += da * db;
    aa += da * da;
    bb += db * db;
  }
  if (aa == 0.0 || bb == 0.0) return NoAnswer{"all values of one side are equal"};
  return ab / std::sqrt(aa * bb);
}

Answer<double> CalcRocArea(const std::vector<double>& scores,
                           const std::vector<bool>& is_positive) {
  GRASPBENCH_DEMAND(scores.size() == is_positive.size(),
                    std::to_string(scores.size()) + " and " + std::to_string(is_positive.size()));
  if (HasNan(scores)) return NoAnswer{"a score is missing"};
  const Ranks ranks = RankValues(scores);
  double num_positive = 0.0, rank_sum = 0.0;
  for (size_t i = 0; i < scores.size(); ++i) {
    if (!is_positive[i]) continue;
    num_positive += 1.0;
    rank_sum += 0.5 * ranks.twice[i];
  }
  const double num_negative = static_cast<double>(scores.size()) - num_positive;
  if (num_positive == 0.0) return NoAnswer{"there is no success"};
  if (num_negative == 0.0) return NoAnswer{"there is no failure"};
  return (rank_sum - 0.5 * num_positive * (num_positive + 1.0)) / (num_positive * num_negative);
}

}  // namespace graspbench
