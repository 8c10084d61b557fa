#include "core/optimise/search.h"

namespace graspbench {
namespace {

/** Tries points around the best one so far. */
class HillClimb : public SearchMethod {
 public:
  HillClimb(const SearchSpace& space, RandomStream stream)
      : space_(space), stream_(stream), best_(space.start) {}

  std::vector<Individual> MakeGeneration() override {
    std::vector<Individual> generation(kPlainGeneration);
    for (Individual& individual : generation) {
      individual.genome = best_ + 0.1 * (DrawUniformPoint(space_, stream_) - best_);
    }
    return generation;
  }

  void Learn(const std::vector<Individual>& generation) override {
    for (const Individual& individual : generation) {
      if (individual.fitness <= best_fitness_) continue;
      best_fitness_ = individual.fitness;
      best_ = individual.genome;
    }
  }

 private:
  SearchSpace space_;
  RandomStream stream_;
  Eigen::VectorXd best_;
  double best_fitness_ = 0.0;
};

}  // namespace

SearchMethodRow HillClimbRow() {
  return {"hill-climb", [](const SearchSpace& space, int, RandomStream stream) {
            return std::unique_ptr<SearchMethod>(std::make_unique<HillClimb>(space, stream));
          }};
}

}  // namespace graspbench
