#include "core/statistics/ranks.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/base/random.h"

namespace graspbench {
namespace {

bool HasNan(const std::vector<double>& values) {
  return std::any_of(values.begin(), values.end(), [](double value) { return std::isnan(value); });
}

/** Centred ranks of one group, divided by its size. */
struct RankedGroup {
  std::vector<double> a, b;
  double ab = 0.0, aa = 0.0, bb = 0.0;
};

std::vector<double> CentreRanks(const std::vector<double>& values) {
  const Ranks ranks = RankValues(values);
  const double count = static_cast<double>(values.size());
  std::vector<double> centred;
  for (const int twice : ranks.twice)
    centred.push_back((0.5 * twice - 0.5 * (count + 1.0)) / count);
  return centred;
}

double SumProducts(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0.0;
  for (size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

/** Keeps only groups that carry information. */
std::vector<RankedGroup> RankGroups(const std::vector<PairedGroup>& groups) {
  std::vector<RankedGroup> ranked;
  for (const PairedGroup& group : groups) {
    GRASPBENCH_DEMAND(group.a.size() == group.b.size(), std::to_string(group.a.size()));
    std::vector<double> a, b;
    for (size_t i = 0; i < group.a.size(); ++i) {
      if (std::isnan(group.a[i]) || std::isnan(group.b[i])) continue;
      a.push_back(group.a[i]);
      b.push_back(group.b[i]);
    }
    if (a.size() < 3) continue;
    RankedGroup result;
    result.a = CentreRanks(a);
    result.b = CentreRanks(b);
    result.ab = SumProducts(result.a, result.b);
    result.aa = SumProducts(result.a, result.a);
    result.bb = SumProducts(result.b, result.b);
    if (result.aa > 0.0 && result.bb > 0.0) ranked.push_back(result);
  }
  return ranked;
}

double CalcPooled(const std::vector<RankedGroup>& groups, const std::vector<size_t>& members) {
  double ab = 0.0, aa = 0.0, bb = 0.0;
  for (const size_t member : members) {
    ab += groups[member].ab;
    aa += groups[member].aa;
    bb += groups[member].bb;
  }
  return ab / std::sqrt(aa * bb);
}

void Shuffle(std::vector<double>& values, RandomStream& random) {
  for (size_t i = values.size(); i > 1; --i) {
    std::swap(values[i - 1], values[random.NextIndex(static_cast<int>(i))]);
  }
}

/** The sums of squares do not depend on the order, so the products alone decide. */
double CalcShuffleP(std::vector<RankedGroup> groups, const std::string& id, int num_shuffles) {
  double found = 0.0;
  for (const RankedGroup& group : groups) found += group.ab;
  // A sum in another order may differ in its last digits.
  const double threshold = std::abs(found) * (1.0 - 1e-9);
  RandomStream random(id, "shuffles");
  int num_as_large = 0;
  for (int k = 0; k < num_shuffles; ++k) {
    double sum = 0.0;
    for (RankedGroup& group : groups) {
      Shuffle(group.b, random);
      sum += SumProducts(group.a, group.b);
    }
    if (std::abs(sum) >= threshold) ++num_as_large;
  }
  return (1.0 + num_as_large) / (1.0 + num_shuffles);
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
  const double mean = static_cast<double>(a.size()) + 1.0;  // of the doubled ranks
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

Answer<WithinCorrelation> CalcWithinCorrelation(const std::vector<PairedGroup>& groups,
                                                const std::string& id, int num_shuffles) {
  const std::vector<RankedGroup> ranked = RankGroups(groups);
  if (ranked.empty()) return NoAnswer{"no group has three pairs that differ on both sides"};
  WithinCorrelation result;
  result.num_groups = static_cast<int>(ranked.size());
  std::vector<size_t> all;
  for (size_t group = 0; group < ranked.size(); ++group) {
    result.num_pairs += static_cast<int>(ranked[group].a.size());
    all.push_back(group);
  }
  result.correlation = CalcPooled(ranked, all);
  const Answer<BootstrapInterval> drawn = CalcBootstrap(
      ranked.size(),
      [&ranked](const std::vector<size_t>& members) { return CalcPooled(ranked, members); }, id,
      num_shuffles);
  result.interval = drawn ? Answer<Interval>(drawn->interval) : Answer<Interval>(drawn.none());
  result.p = CalcShuffleP(ranked, id, num_shuffles);
  return result;
}

}  // namespace graspbench
