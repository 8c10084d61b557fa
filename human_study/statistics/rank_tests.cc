#include "human_study/statistics/rank_tests.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/base/text/text.h"
#include "core/statistics/distributions.h"
#include "core/statistics/ranks.h"

namespace graspbench {
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
