#pragma once
/** @file
Races the individuals of a generation: those are simulated of which earlier evaluations promise
most, the others are given up for what is promised of them. A promise is the mean of the five
nearest simulated individuals, weighted by the inverse square of their distance in the box
(Shepard 1968); choosing by it before a costly evaluation is pre-selection (Jin, Swarm and
Evolutionary Computation 1:61, 2011). Costs no simulation. All of the first two generations are
simulated, the start among them, then kRacedShare of each.

One that was given up counts less than the worst that was simulated of its generation, so that it is
no parent before those. Deterministic: the same fitness leads to the same questions, so a stopped
race goes on as a search does. Blind to: good places far from all that was simulated, which only
look as good as their surroundings. */

#include <vector>

#include "core/optimise/methods/search.h"

namespace graspbench {

class Race {
 public:
  static constexpr double kRacedShare = 0.28;

  explicit Race(const SearchSpace& space) : space_(space) {}

  /** @param simulate  is asked for a part of the generation, in its order.
  @returns the fitness of each of the generation. */
  std::vector<double> Evaluate(const std::vector<Individual>& generation,
                               const EvaluateGeneration& simulate);

 private:
  double Promise(const Eigen::VectorXd& genome) const;

  SearchSpace space_;
  std::vector<Individual> known_;  // simulated
};

}  // namespace graspbench
