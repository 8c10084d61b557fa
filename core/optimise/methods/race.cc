#include "core/optimise/methods/race.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace graspbench {
namespace {

constexpr int kNumNearest = 5;
constexpr int kWholeGenerations = 2;
constexpr double kSamePlace = 1e-9;  ///< of the box

}  // namespace

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
