#include "core/optimise/search.h"

#include <algorithm>
#include <cmath>

#include "core/base/error.h"
#include "core/optimise/cma_es.h"
#include "core/optimise/differential_evolution.h"
#include "core/optimise/evolution_strategy.h"
#include "core/optimise/plain_search.h"

namespace graspbench {

const std::vector<std::string>& ListSearchMethods() {
  static const std::vector<std::string> methods = {"es", "cmaes", "de", "random", "grid"};
  return methods;
}

std::unique_ptr<SearchMethod> MakeSearchMethod(const std::string& name, const SearchSpace& space,
                                               int num_evaluations, RandomStream stream) {
  if (name == "es") return std::make_unique<EvolutionStrategy>(space, stream);
  if (name == "cmaes") return std::make_unique<CmaEs>(space, stream);
  if (name == "de") return std::make_unique<DifferentialEvolution>(space, stream);
  if (name == "random") return std::make_unique<RandomSearch>(space, stream);
  if (name == "grid") return std::make_unique<GridSearch>(space, num_evaluations - 1);
  throw Error(ErrorKind::kNotFound,
              "no search method \"" + name + "\"" + SuggestNames(name, ListSearchMethods()));
}

SearchResult RunSearch(const std::string& name, const SearchSpace& space, int num_evaluations,
                       RandomStream stream, const EvaluateGeneration& evaluate) {
  GRASPBENCH_DEMAND(num_evaluations >= 1, std::to_string(num_evaluations));
  const auto method = MakeSearchMethod(name, space, num_evaluations, stream);
  SearchResult result;
  Individual start;
  start.genome = space.start;
  std::vector<Individual> generation = {start};
  for (int number = 0; !generation.empty(); ++number) {
    const size_t left = static_cast<size_t>(num_evaluations) - result.individuals.size();
    const bool is_cut = generation.size() >= left;
    if (is_cut) generation.resize(left);
    for (Individual& individual : generation) {
      individual.number = static_cast<int>(result.individuals.size());
      individual.number += static_cast<int>(&individual - generation.data());
      individual.generation = number;
    }
    const std::vector<double> fitness = evaluate(generation);
    GRASPBENCH_DEMAND(fitness.size() == generation.size(), std::to_string(fitness.size()));
    for (size_t i = 0; i < generation.size(); ++i) {
      generation[i].fitness = fitness[i];
      result.individuals.push_back(generation[i]);
      const double best = result.individuals[static_cast<size_t>(result.best)].fitness;
      if (fitness[i] > best) result.best = generation[i].number;
    }
    if (is_cut) break;
    method->Learn(generation);
    generation = method->MakeGeneration();
  }
  return result;
}

Eigen::VectorXd ReflectInto(const SearchSpace& space, Eigen::VectorXd point) {
  for (Eigen::Index i = 0; i < point.size(); ++i) {
    const double low = space.lower[i], width = space.upper[i] - low;
    // Mirrored at both ends, a coordinate repeats itself after twice the width.
    const double over = width > 0.0 ? std::fmod(std::abs(point[i] - low), 2.0 * width) : 0.0;
    point[i] = std::clamp(low + (over <= width ? over : 2.0 * width - over), low, space.upper[i]);
  }
  return point;
}

}  // namespace graspbench
