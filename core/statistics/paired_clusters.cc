#include "core/statistics/paired_clusters.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "core/statistics/distributions.h"

namespace graspbench {
namespace {

constexpr double kDecisionLevel = 0.05;
constexpr int kMostPairsPlanned = 1000000;

int CalcGain(const PairedCounts& counts) { return counts.second_only - counts.first_only; }

double CalcPower(const PairedPlan& plan, double num_pairs) {
  const double k = plan.num_clusters, difference = plan.difference;
  const double variance = (std::max(plan.discordance, difference) - difference * difference);
  const double error = std::sqrt(variance / num_pairs + plan.spread * plan.spread / k);
  if (error == 0.0) return 1.0;
  return CalcNoncentralStudentUpperP(
      CalcStudentQuantile(1.0 - kDecisionLevel / 2.0, k - 1.0), k - 1.0,
      std::clamp((difference - 1.0 / num_pairs) / error, 0.0, 100.0));
}

}  // namespace

double CalcClusteredExactTwoSided(const std::vector<PairedCounts>& clusters) {
  int all = 0, observed = 0;
  for (const PairedCounts& counts : clusters) {
    all += std::abs(CalcGain(counts));
    observed += CalcGain(counts);
  }
  // Probability of each sum; index `all` is the sum 0.
  std::vector<double> shares(2 * static_cast<size_t>(all) + 1, 0.0);
  shares[static_cast<size_t>(all)] = 1.0;
  for (const PairedCounts& counts : clusters) {
    const auto step = static_cast<size_t>(std::abs(CalcGain(counts)));
    if (step == 0) continue;
    std::vector<double> next(shares.size(), 0.0);
    for (size_t i = 0; i < shares.size(); ++i) {
      if (shares[i] == 0.0) continue;
      next[i - step] += shares[i] / 2.0;
      next[i + step] += shares[i] / 2.0;
    }
    shares = std::move(next);
  }
  double p = 0.0;
  for (size_t i = 0; i < shares.size(); ++i) {
    if (std::abs(static_cast<int>(i) - all) >= std::abs(observed)) p += shares[i];
  }
  return std::min(p, 1.0);
}

std::optional<int> CalcPairsNeeded(const PairedPlan& plan, double power) {
  if (plan.num_clusters < static_cast<int>(kFewestClusters)) return std::nullopt;
  const int most = kMostPairsPlanned / plan.num_clusters;
  int low = 0, high = 1;  // pairs per object: too few, enough
  while (CalcPower(plan, high * plan.num_clusters) < power) {
    low = high;
    high *= 2;
    if (high > most) return std::nullopt;
  }
  while (high - low > 1) {
    const int middle = (low + high) / 2;
    (CalcPower(plan, middle * plan.num_clusters) < power ? low : high) = middle;
  }
  return high * plan.num_clusters;
}

PairedPlan EstimatePairedPlan(const std::vector<PairedCounts>& clusters, double difference) {
  PairedPlan plan;
  plan.difference = difference;
  double num_pairs = 0.0, num_differing = 0.0, sum = 0.0;
  for (const PairedCounts& counts : clusters) {
    if (counts.num_pairs() == 0) continue;
    ++plan.num_clusters;
    num_pairs += counts.num_pairs();
    num_differing += counts.first_only + counts.second_only;
    sum += static_cast<double>(CalcGain(counts)) / counts.num_pairs();
  }
  if (num_pairs == 0.0) return plan;
  plan.discordance = num_differing / num_pairs;
  if (plan.num_clusters < 2) return plan;
  const double mean = sum / plan.num_clusters;
  double between = 0.0, by_chance = 0.0;  // variances of the objects' differences
  for (const PairedCounts& counts : clusters) {
    const double n = counts.num_pairs();
    if (n == 0.0) continue;
    between += std::pow(CalcGain(counts) / n - mean, 2) / (plan.num_clusters - 1);
    by_chance += (plan.discordance - mean * mean) / n / plan.num_clusters;
  }
  plan.spread = std::sqrt(std::max(0.0, between - by_chance));
  return plan;
}

}  // namespace graspbench
