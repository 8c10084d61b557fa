#pragma once
/** @file
Differential evolution rand/1/bin: population 20, F = 0.5, CR = 0.9. The first population is the
start and uniform points of the box; a child takes its parent's place when it is not worse.
Source: Storn and Price, "Differential evolution", J. of Global Optimization 11 (1997). */

#include "core/optimise/methods/search.h"

namespace graspbench {

class DifferentialEvolution : public SearchMethod {
 public:
  DifferentialEvolution(const SearchSpace& space, RandomStream stream);
  std::vector<Individual> MakeGeneration() override;
  void Learn(const std::vector<Individual>& generation) override;

 private:
  Individual MakeChild(size_t place);

  SearchSpace space_;
  RandomStream stream_;
  std::vector<Individual> population_;
};

}  // namespace graspbench
