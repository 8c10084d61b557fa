#include "core/statistics/proportion.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/base/text/text.h"
#include "core/statistics/distributions.h"

namespace graspbench {
namespace {

void DemandCounts(int num_successes, int num_trials) {
  GRASPBENCH_DEMAND(0 <= num_successes && num_successes <= num_trials,
                    std::to_string(num_successes) + " of " + std::to_string(num_trials));
}

}  // namespace

double CalcShare(int64_t count, int64_t num_all) {
  return num_all > 0 ? static_cast<double>(count) / static_cast<double>(num_all) : std::nan("");
}

Interval CalcWilsonInterval(int num_successes, int num_trials) {
  DemandCounts(num_successes, num_trials);
  if (num_trials == 0) return {0.0, 1.0};
  constexpr double kZ = 1.959963984540054;  // 97.5 % quantile of the standard normal
  const double n = num_trials;
  const double p = num_successes / n;
  const double centre = p + kZ * kZ / (2.0 * n);
  const double half_width = kZ * std::sqrt(p * (1.0 - p) / n + kZ * kZ / (4.0 * n * n));
  const double scale = 1.0 + kZ * kZ / n;
  // Exactly 0 and 1 at the extremes, without rounding errors.
  return {num_successes == 0 ? 0.0 : (centre - half_width) / scale,
          num_successes == num_trials ? 1.0 : (centre + half_width) / scale};
}

Interval CalcPairedDifferenceInterval(const PairedCounts& counts) {
  const int num_pairs = counts.num_pairs();
  if (num_pairs == 0) return {-1.0, 1.0};
  const double a = counts.both, b = counts.first_only, c = counts.second_only, d = counts.neither;
  const Interval first = CalcWilsonInterval(counts.both + counts.first_only, num_pairs);
  const Interval second = CalcWilsonInterval(counts.both + counts.second_only, num_pairs);
  const double p1 = (a + b) / num_pairs, p2 = (a + c) / num_pairs;
  const double margins = (a + b) * (c + d) * (a + c) * (b + d);
  double numerator = a * d - b * c;
  if (numerator > 0.0) numerator = std::max(numerator - 0.5 * num_pairs, 0.0);
  const double phi = margins > 0.0 ? numerator / std::sqrt(margins) : 0.0;
  const auto combine = [phi](double x, double y) {
    return std::sqrt(std::max(0.0, x * x - 2.0 * phi * x * y + y * y));
  };
  return {p2 - p1 - combine(p2 - second.low, first.high - p1),
          p2 - p1 + combine(second.high - p2, p1 - first.low)};
}

double CalcMcNemarExactTwoSided(const PairedCounts& counts) {
  const int num_different = counts.first_only + counts.second_only;
  const int more = std::max(counts.first_only, counts.second_only);
  return std::min(1.0, 2.0 * CalcBinomialUpperP(more, num_different, 0.5));
}

double CalcFisherExactTwoSided(int num_successes_a, int num_trials_a, int num_successes_b,
                               int num_trials_b) {
  DemandCounts(num_successes_a, num_trials_a);
  DemandCounts(num_successes_b, num_trials_b);
  const int num_trials = num_trials_a + num_trials_b;
  const int num_successes = num_successes_a + num_successes_b;
  std::vector<double> log_factorial(static_cast<size_t>(num_trials) + 1, 0.0);
  for (size_t i = 2; i < log_factorial.size(); ++i) {
    log_factorial[i] = log_factorial[i - 1] + std::log(static_cast<double>(i));
  }
  const auto log_choose = [&](int n, int k) {
    const auto at = [&](int i) { return log_factorial[i]; };
    return at(n) - at(k) - at(n - k);
  };
  const auto log_probability = [&](int k) {  // of k successes in group a
    return log_choose(num_trials_a, k) + log_choose(num_trials_b, num_successes - k) -
           log_choose(num_trials, num_successes);
  };
  // Equally probable tables must count as equal despite rounding.
  const double limit = log_probability(num_successes_a) + 1e-7;
  double p = 0.0;
  for (int k = std::max(0, num_successes - num_trials_b);
       k <= std::min(num_trials_a, num_successes); ++k) {
    if (log_probability(k) <= limit) p += std::exp(log_probability(k));
  }
  return std::min(p, 1.0);
}

std::string FormatRate(int num_successes, int num_trials) {
  std::string counts = std::to_string(num_successes) + " of " + FormatCount(num_trials, "trial");
  if (num_trials == 0) return counts;
  return counts + " (" + FormatPercent(CalcShare(num_successes, num_trials)) +
         ", 95\u00A0% interval " + FormatRateInterval(num_successes, num_trials) + "\u00A0%)";
}

std::string FormatRateInterval(int num_successes, int num_trials) {
  if (num_trials == 0) return "n/a";
  const Interval interval = CalcWilsonInterval(num_successes, num_trials);
  return FormatRange(100.0 * interval.low, 100.0 * interval.high, 1);
}

}  // namespace graspbench
