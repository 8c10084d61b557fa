#include "core/optimise/methods/evolution_strategy.h"

#include <algorithm>
#include <cmath>

namespace graspbench {
namespace {

/** Steps stay within these multiples of the first one: neither stuck nor beyond the box. */
constexpr double kSmallestStep = 0.01;
constexpr double kLargestStep = 3.0;

}  // namespace

EvolutionStrategy::EvolutionStrategy(const SearchSpace& space, RandomStream stream)
    : space_(space), stream_(stream) {}

Individual EvolutionStrategy::MakeChild() {
  const int n = space_.size();
  const double tau_common = 1.0 / std::sqrt(2.0 * n);
  const double tau_each = 1.0 / std::sqrt(2.0 * std::sqrt(static_cast<double>(n)));
  const int num_parents = static_cast<int>(parents_.size());
  const Individual& a = parents_[static_cast<size_t>(stream_.NextIndex(num_parents))];
  const Individual& b = parents_[static_cast<size_t>(stream_.NextIndex(num_parents))];

  Individual child;
  child.parents = {a.number, b.number};
  child.genome = 0.5 * (a.genome + b.genome);
  child.steps = 0.5 * (a.steps + b.steps);
  const double common = tau_common * stream_.NextNormal();
  for (int i = 0; i < n; ++i) {
    const double step = child.steps[i] * std::exp(common + tau_each * stream_.NextNormal());
    child.steps[i] = std::clamp(step, kSmallestStep * space_.step, kLargestStep * space_.step);
    child.genome[i] += child.steps[i] * stream_.NextNormal();
  }
  child.genome = ReflectInto(space_, child.genome);
  return child;
}

std::vector<Individual> EvolutionStrategy::MakeGeneration() {
  std::vector<Individual> children;
  for (int i = 0; i < kNumChildren; ++i) children.push_back(MakeChild());
  return children;
}

void EvolutionStrategy::Learn(const std::vector<Individual>& generation) {
  const bool is_start = parents_.empty();
  parents_ = generation;
  std::stable_sort(parents_.begin(), parents_.end(),
                   [](const auto& a, const auto& b) { return a.fitness > b.fitness; });
  if (is_start) {
    for (Individual& parent : parents_) {
      parent.steps = Eigen::VectorXd::Constant(space_.size(), space_.step);
    }
    best_ = parents_.front();
    return;
  }
  parents_.resize(kNumParents);
  if (parents_.front().fitness > best_.fitness) {
    best_ = parents_.front();
  } else {
    parents_.back() = best_;
  }
}

SearchMethodRow EvolutionStrategyRow() {
  return {
      "es", [](const SearchSpace& space, int, RandomStream stream) {
        return std::unique_ptr<SearchMethod>(std::make_unique<EvolutionStrategy>(space, stream));
      }};
}

}  // namespace graspbench
