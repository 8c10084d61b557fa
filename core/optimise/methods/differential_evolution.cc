/** @file
Differential evolution rand/1/bin: population 20, F = 0.5, CR = 0.9. The first population consists
of the start and uniform points of the box. A child replaces its parent if it is not worse.
Source: Storn and Price, "Differential evolution", J. of Global Optimization 11 (1997). */

#include "core/optimise/methods/search.h"

namespace graspbench {
namespace {

constexpr size_t kPopulation = 20;
constexpr double kScale = 0.5;      // F
constexpr double kCrossover = 0.9;  // CR

class DifferentialEvolution : public SearchMethod {
 public:
  DifferentialEvolution(const SearchSpace& space, RandomStream stream)
      : space_(space), stream_(stream) {}

  std::vector<Individual> MakeGeneration() override {
    std::vector<Individual> children;
    if (population_.size() < kPopulation) {
      while (population_.size() + children.size() < kPopulation) {
        Individual individual;
        individual.genome = DrawUniformPoint(space_, stream_);
        children.push_back(individual);
      }
      return children;
    }
    for (size_t place = 0; place < kPopulation; ++place) children.push_back(MakeChild(place));
    return children;
  }

  void Learn(const std::vector<Individual>& generation) override {
    if (population_.size() < kPopulation) {
      population_.insert(population_.end(), generation.begin(), generation.end());
      return;
    }
    for (size_t place = 0; place < kPopulation; ++place) {
      if (generation[place].fitness >= population_[place].fitness) {
        population_[place] = generation[place];
      }
    }
  }

 private:
  Individual MakeChild(size_t place) {
    const Individual& parent = population_[place];
    // Three other individuals, all different.
    size_t picked[3];
    for (int k = 0; k < 3;) {
      picked[k] = static_cast<size_t>(stream_.NextIndex(static_cast<int>(kPopulation)));
      bool is_new = picked[k] != place;
      for (int other = 0; other < k; ++other) is_new = is_new && picked[k] != picked[other];
      if (is_new) ++k;
    }
    const Individual &a = population_[picked[0]], &b = population_[picked[1]],
                     &c = population_[picked[2]];
    Individual child;
    child.parents = {parent.number, a.number, b.number, c.number};
    child.genome = parent.genome;
    const int surely = stream_.NextIndex(space_.size());
    for (int i = 0; i < space_.size(); ++i) {
      if (stream_.NextUnit() < kCrossover || i == surely) {
        child.genome[i] = a.genome[i] + kScale * (b.genome[i] - c.genome[i]);
      }
    }
    child.genome = ReflectInto(space_, child.genome);
    return child;
  }

  SearchSpace space_;
  RandomStream stream_;
  std::vector<Individual> population_;
};

}  // namespace

std::unique_ptr<SearchMethod> MakeDifferentialEvolution(const SearchSpace& space, int,
                                                        RandomStream stream) {
  return std::make_unique<DifferentialEvolution>(space, stream);
}

}  // namespace graspbench
