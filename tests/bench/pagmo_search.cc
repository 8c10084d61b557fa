#include "tests/bench/pagmo_search.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <pagmo/algorithms/cmaes.hpp>
#include <pagmo/population.hpp>
#include <pagmo/problem.hpp>
#include <utility>

namespace graspbench {
namespace {

/** pagmo copies problems; all copies ask the same. */
struct Asked {
  const SearchSpace& space;
  const EvaluateGeneration& evaluate;
  SearchResult result;
  int generation_size = 1;

  double Ask(const Eigen::VectorXd& genome) {
    Individual individual;
    individual.number = static_cast<int>(result.individuals.size());
    individual.generation = (individual.number + generation_size - 1) / generation_size;
    individual.genome = genome.cwiseMax(space.lower).cwiseMin(space.upper);
    individual.fitness = evaluate({individual}).at(0);
    result.individuals.push_back(individual);
    const double best = result.individuals[static_cast<size_t>(result.best)].fitness;
    if (individual.fitness > best) result.best = individual.number;
    return individual.fitness;
  }
};

struct Problem {
  std::shared_ptr<Asked> asked;

  pagmo::vector_double fitness(const pagmo::vector_double& x) const {
    const auto size = static_cast<Eigen::Index>(x.size());
    return {-asked->Ask(Eigen::Map<const Eigen::VectorXd>(x.data(), size))};
  }
  std::pair<pagmo::vector_double, pagmo::vector_double> get_bounds() const {
    const SearchSpace& space = asked->space;
    return {{space.lower.begin(), space.lower.end()}, {space.upper.begin(), space.upper.end()}};
  }
};

}  // namespace

SearchResult RunPagmoSearch(const SearchSpace& space, int num_evaluations, unsigned seed,
                            const EvaluateGeneration& evaluate) {
  const int size = std::max(5, 4 + static_cast<int>(std::floor(3.0 * std::log(space.size()))));
  const auto asked = std::make_shared<Asked>(Asked{space, evaluate, {}, size});
  const double start = asked->Ask(space.start);
  pagmo::population population(pagmo::problem(Problem{asked}), 0, seed);
  const pagmo::vector_double x(space.start.begin(), space.start.end());
  for (int i = 0; i < size; ++i) population.push_back(x, {-start});
  // Its first step is a share of each coordinate's width; it ends by the budget alone.
  const double share = space.step / (space.upper - space.lower).mean();
  const auto generations = static_cast<unsigned>((num_evaluations - 1) / size);
  const pagmo::cmaes method(generations, -1, -1, -1, -1, share, 0.0, 0.0, false, true, seed);
  method.evolve(std::move(population));
  return std::move(asked->result);
}

}  // namespace graspbench
