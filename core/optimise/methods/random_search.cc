#include "core/optimise/methods/random_search.h"

namespace graspbench {

std::vector<Individual> RandomSearch::MakeGeneration() {
  std::vector<Individual> generation(kPlainGeneration);
  for (Individual& individual : generation) individual.genome = DrawUniformPoint(space_, stream_);
  return generation;
}

SearchMethodRow RandomSearchRow() {
  return {"random", [](const SearchSpace& space, int, RandomStream stream) {
            return std::unique_ptr<SearchMethod>(std::make_unique<RandomSearch>(space, stream));
          }};
}

}  // namespace graspbench
