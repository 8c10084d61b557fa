/** @file
Evolution strategy (5, 20) with elitism, the default of step 2 (proposed by graspbench; the thesis
says "evolutionary algorithm").

    child       the mean of two parents drawn at random, genome and steps (intermediate
                recombination)
    its steps   s_i <- s_i exp(tau' N(0, 1) + tau N_i(0, 1)),  tau' = 1 / sqrt(2 n),
                tau = 1 / sqrt(2 sqrt(n))  (self-adaptation)
    its genome  x_i <- x_i + s_i N_i(0, 1), mirrored at the bounds
    parents     the 5 best of the 20 children; if the best individual so far is not among them, it
                replaces the fifth (elitism)

Source: H.-P. Schwefel, "Evolution and optimum seeking", 1995; Beyer and Schwefel, "Evolution
strategies: a comprehensive introduction", Natural Computing 1 (2002). */

#include <algorithm>
#include <cmath>

#include "core/optimise/methods/search.h"

namespace graspbench {
namespace {

/** Steps stay within these multiples of the first, so that they neither vanish nor leave the
box. */
constexpr double kSmallestStep = 0.01;
constexpr double kLargestStep = 3.0;

class EvolutionStrategy : public SearchMethod {
 public:
  static constexpr int kNumParents = 5;
  static constexpr int kNumChildren = 20;

  EvolutionStrategy(const SearchSpace& space, RandomStream stream)
      : space_(space), stream_(stream) {}

  std::vector<Individual> MakeGeneration() override {
    std::vector<Individual> children;
    for (int i = 0; i < kNumChildren; ++i) children.push_back(MakeChild());
    return children;
  }

  void Learn(const std::vector<Individual>& generation) override {
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

 private:
  Individual MakeChild() {
    const int n = space_.size();
    const double tau_common = 1.0 / std::sqrt(2.0 * n);
    const double tau_each = 1.0 / std::sqrt(2.0 * std::sqrt(static_cast<double>(n)));
    const int num_parents = static_cast<int>(parents_.size());
    const Individual& a = parents_[stream_.NextIndex(num_parents)];
    const Individual& b = parents_[stream_.NextIndex(num_parents)];

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

  SearchSpace space_;
  RandomStream stream_;
  std::vector<Individual> parents_;  // best first
  Individual best_;                  // of all so far
};

}  // namespace

std::unique_ptr<SearchMethod> MakeEvolutionStrategy(const SearchSpace& space, int,
                                                    RandomStream stream) {
  return std::make_unique<EvolutionStrategy>(space, stream);
}

}  // namespace graspbench
