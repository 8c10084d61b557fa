#include "core/optimise/methods/search.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/base/enum_table.h"

namespace graspbench {
namespace {

constexpr int kNumNearest = 5;
constexpr int kWholeGenerations = 2;
constexpr double kSamePlace = 1e-9;  ///< share of the box

/** Generation size of a method that does not learn: as for the evolution strategy. */
constexpr int kPlainGeneration = 20;

/** Uniform sampling of the box, without learning: the baseline. */
class RandomSearch : public SearchMethod {
 public:
  RandomSearch(const SearchSpace& space, RandomStream stream) : space_(space), stream_(stream) {}
  std::vector<Individual> MakeGeneration() override {
    std::vector<Individual> generation(kPlainGeneration);
    for (Individual& individual : generation) individual.genome = DrawUniformPoint(space_, stream_);
    return generation;
  }
  void Learn(const std::vector<Individual>&) override {}

 private:
  SearchSpace space_;
  RandomStream stream_;
};

int CalcPower(int base, int exponent) {
  int power = 1;
  for (int i = 0; i < exponent; ++i) power *= base;
  return power;
}

/** A regular grid, for few coordinates: as many equidistant points in each as `num_points` allow,
including the faces. */
class GridSearch : public SearchMethod {
 public:
  /** @throws Error(kUnsupported) for more than three coordinates, or for fewer than two points per
  coordinate. */
  GridSearch(const SearchSpace& space, int num_points) : space_(space) {
    if (space.size() > 3) {
      throw Error(ErrorKind::kUnsupported,
                  "a grid is possible for at most three coordinates, this search has " +
                      std::to_string(space.size()) + "; choose another method");
    }
    points_each_ = 1;
    while (CalcPower(points_each_ + 1, space.size()) <= num_points) ++points_each_;
    if (points_each_ < 2) {
      throw Error(ErrorKind::kUnsupported, "a grid needs at least " +
                                               std::to_string(CalcPower(2, space.size()) + 1) +
                                               " evaluations");
    }
    num_points_ = CalcPower(points_each_, space.size());
  }
  /** Empty once the whole grid was returned. */
  std::vector<Individual> MakeGeneration() override {
    std::vector<Individual> generation;
    for (; next_ < num_points_ && generation.size() < kPlainGeneration; ++next_) {
      Individual individual;
      individual.genome = space_.lower;
      for (int i = 0, rest = next_; i < space_.size(); ++i, rest /= points_each_) {
        individual.genome[i] +=
            (space_.upper[i] - space_.lower[i]) * (rest % points_each_) / (points_each_ - 1);
      }
      generation.push_back(individual);
    }
    return generation;
  }
  void Learn(const std::vector<Individual>&) override {}

 private:
  SearchSpace space_;
  int points_each_ = 0;
  int num_points_ = 1;
  int next_ = 0;
};

struct SearchMethodRow {
  const char* name;
  std::unique_ptr<SearchMethod> (*make)(const SearchSpace& space, int num_evaluations,
                                        RandomStream stream);
};
constexpr SearchMethodRow kMethods[] = {
    {"es", MakeEvolutionStrategy},
    {"cmaes", MakeCmaEs},
    {"de", MakeDifferentialEvolution},
    {"random",
     [](const SearchSpace& space, int, RandomStream stream) -> std::unique_ptr<SearchMethod> {
       return std::make_unique<RandomSearch>(space, stream);
     }},
    {"grid",
     [](const SearchSpace& space, int num_evaluations,
        RandomStream) -> std::unique_ptr<SearchMethod> {
       return std::make_unique<GridSearch>(space, num_evaluations - 1);  // after the start
     }},
};

}  // namespace

const std::vector<std::string>& ListSearchMethods() {
  static const std::vector<std::string> names = ListNames(kMethods);
  return names;
}

std::unique_ptr<SearchMethod> MakeSearchMethod(const std::string& name, const SearchSpace& space,
                                               int num_evaluations, RandomStream stream) {
  if (const SearchMethodRow* row = FindRow(kMethods, name)) {
    return row->make(space, num_evaluations, stream);
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
      const double best = result.individuals[result.best].fitness;
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
    // Mirrored at both ends, a coordinate has a period of twice the width.
    const double over = width > 0.0 ? std::fmod(std::abs(point[i] - low), 2.0 * width) : 0.0;
    point[i] = std::clamp(low + (over <= width ? over : 2.0 * width - over), low, space.upper[i]);
  }
  return point;
}

double Race::Promise(const Eigen::VectorXd& genome) const {
  const Eigen::VectorXd width = (space_.upper - space_.lower).cwiseMax(kSamePlace);
  std::vector<std::pair<double, double>> near;  // squared distance, fitness
  for (const Individual& individual : known_) {
    const double distance = (individual.genome - genome).cwiseQuotient(width).squaredNorm();
    near.emplace_back(std::max(distance, kSamePlace * kSamePlace), individual.fitness);
  }
  const size_t count = std::min<size_t>(near.size(), kNumNearest);
  std::partial_sort(near.begin(), near.begin() + static_cast<std::ptrdiff_t>(count), near.end());
  double sum = 0.0, weights = 0.0;
  for (size_t i = 0; i < count; ++i) {
    sum += near[i].second / near[i].first;
    weights += 1.0 / near[i].first;
  }
  return sum / weights;
}

std::vector<double> Race::Evaluate(const std::vector<Individual>& generation,
                                   const EvaluateGeneration& simulate) {
  std::vector<double> fitness(generation.size(), 0.0);
  std::vector<size_t> order(generation.size());
  std::iota(order.begin(), order.end(), size_t{0});
  if (generation.front().generation >= kWholeGenerations) {
    for (size_t i = 0; i < generation.size(); ++i) fitness[i] = Promise(generation[i].genome);
    std::stable_sort(order.begin(), order.end(),
                     [&](size_t a, size_t b) { return fitness[a] > fitness[b]; });
    const double share = kRacedShare * static_cast<double>(generation.size());
    order.resize(static_cast<size_t>(std::max(1.0, std::floor(share))));
    std::sort(order.begin(), order.end());
  }
  std::vector<Individual> chosen;
  for (const size_t i : order) chosen.push_back(generation[i]);
  const std::vector<double> found = simulate(chosen);
  const double most = std::nextafter(*std::min_element(found.begin(), found.end()),
                                     -std::numeric_limits<double>::infinity());
  for (double& promised : fitness) promised = std::min(promised, most);
  for (size_t k = 0; k < order.size(); ++k) {
    fitness[order[k]] = chosen[k].fitness = found[k];
    known_.push_back(chosen[k]);
  }
  return fitness;
}

}  // namespace graspbench
