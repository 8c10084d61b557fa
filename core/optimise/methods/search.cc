#include "core/optimise/methods/search.h"

#include <algorithm>
#include <cmath>

#include "core/base/error.h"

namespace graspbench {

namespace {

const std::vector<SearchMethodRow>& ListRows() {
  static const std::vector<SearchMethodRow> rows = {
#define GRASPBENCH_SEARCH_METHOD(Class) Class##Row(),
#include "core/optimise/methods/search_method_list.inc"
#undef GRASPBENCH_SEARCH_METHOD
  };
  return rows;
}

}  // namespace

const std::vector<std::string>& ListSearchMethods() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const SearchMethodRow& row : ListRows()) all.push_back(row.name);
    return all;
  }();
  return names;
}

std::unique_ptr<SearchMethod> MakeSearchMethod(const std::string& name, const SearchSpace& space,
                                               int num_evaluations, RandomStream stream) {
  for (const SearchMethodRow& row : ListRows()) {
    if (name == row.name) return row.make(space, num_evaluations, stream);
  }
  throw Error(ErrorKind::kNotFound,
              "no search method \"" + name + "\"" + SuggestNames(name, ListSearchMethods()));
}

Eigen::VectorXd DrawUniformPoint(const SearchSpace& space, RandomStream& stream) {
  Eigen::VectorXd point(space.size());
  for (Eigen::Index i = 0; i < point.size(); ++i) {
    point[i] = stream.NextUniform(space.lower[i], space.upper[i]);
  }
  return point;
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
