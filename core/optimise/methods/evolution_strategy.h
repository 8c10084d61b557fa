#pragma once
/** @file
Evolution strategy (5, 20) with elitism, the default of step 2 (proposed by graspbench; the thesis
says "evolutionary algorithm").

    child       the mean of two parents drawn at random, genome and steps (intermediate
                recombination)
    its steps   s_i <- s_i exp(tau' N(0, 1) + tau N_i(0, 1)),  tau' = 1 / sqrt(2 n),
                tau = 1 / sqrt(2 sqrt(n))  (self-adaptation)
    its genome  x_i <- x_i + s_i N_i(0, 1), mirrored at the bounds
    parents     the 5 best of the 20 children; if the best individual so far is not among them, it
                takes the place of the fifth (elitism)

Source: H.-P. Schwefel, "Evolution and optimum seeking", 1995; Beyer and Schwefel, "Evolution
strategies: a comprehensive introduction", Natural Computing 1 (2002). */

#include "core/optimise/methods/search.h"

namespace graspbench {

class EvolutionStrategy : public SearchMethod {
 public:
  static constexpr int kNumParents = 5;
  static constexpr int kNumChildren = 20;

  EvolutionStrategy(const SearchSpace& space, RandomStream stream);
  std::vector<Individual> MakeGeneration() override;
  void Learn(const std::vector<Individual>& generation) override;

 private:
  Individual MakeChild();

  SearchSpace space_;
  RandomStream stream_;
  std::vector<Individual> parents_;  // best first
  Individual best_;                  // of all so far
};

}  // namespace graspbench
