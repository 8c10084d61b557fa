#pragma once
/** @file
A search that learns nothing: the yardstick. */

#include "core/optimise/methods/search.h"

namespace graspbench {

/** Uniform in the box. */
class RandomSearch : public SearchMethod {
 public:
  RandomSearch(const SearchSpace& space, RandomStream stream) : space_(space), stream_(stream) {}
  std::vector<Individual> MakeGeneration() override;
  void Learn(const std::vector<Individual>&) override {}

 private:
  SearchSpace space_;
  RandomStream stream_;
};

}  // namespace graspbench
