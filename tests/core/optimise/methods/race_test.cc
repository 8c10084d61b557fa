#include "core/optimise/methods/race.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/base/units.h"

namespace graspbench {
namespace {

using Eigen::VectorXd;

SearchSpace MakeBox(int size) {
  const VectorXd one = VectorXd::Ones(size);
  return {-one, one, 0.0 * one, 0.32};
}

/** From an optimum that is elsewhere for each seed. */
struct Landscape {
  VectorXd optimum;
  bool is_rugged;
  int num_asked = 0;

  Landscape(int size, int seed, bool rugged) : is_rugged(rugged) {
    RandomStream stream(std::to_string(seed), "landscape of the race's test");
    optimum = 0.8 * DrawUniformPoint(MakeBox(size), stream);
  }
  double Calc(const VectorXd& x) const {
    const VectorXd d = x - optimum;
    if (!is_rugged) return -d.squaredNorm();
    return -(25.0 * d.array().square() + 10.0 - 10.0 * (10.0 * kPi * d.array()).cos()).sum();
  }
  std::vector<double> operator()(const std::vector<Individual>& generation) {
    std::vector<double> fitness;
    for (const Individual& individual : generation) fitness.push_back(Calc(individual.genome));
    num_asked += static_cast<int>(generation.size());
    return fitness;
  }
};

double Search(Landscape& landscape, int size, int seed, int num_evaluations, bool is_raced) {
  Race race(MakeBox(size));
  const auto simulate = [&](const auto& generation) { return landscape(generation); };
  const SearchResult result = RunSearch(
      "es", MakeBox(size), num_evaluations, RandomStream(std::to_string(seed), "race test"),
      [&](const std::vector<Individual>& generation) {
        return is_raced ? race.Evaluate(generation, simulate) : simulate(generation);
      });
  const Individual& best = result.individuals[static_cast<size_t>(result.best)];
  EXPECT_EQ(best.fitness, landscape.Calc(best.genome));  // never one that was given up
  return best.fitness;
}

// A thousand that are raced ask for fewer simulations than 300 that are not, and end nearer.
TEST(Race, AThousandRacedEndNearerThanThreeHundred) {
  for (const bool is_rugged : {false, true}) {
    for (const int size : {3, 5}) {
      std::vector<double> raced, plain;
      for (int seed = 1; seed <= 11; ++seed) {
        Landscape landscape(size, seed, is_rugged);
        raced.push_back(Search(landscape, size, seed, 1000, true));
        EXPECT_LE(landscape.num_asked, 300);
        plain.push_back(Search(landscape, size, seed, 300, false));
      }
      std::sort(raced.begin(), raced.end());
      std::sort(plain.begin(), plain.end());
      EXPECT_GT(raced[5], plain[5]) << is_rugged << " " << size;
    }
  }
}

std::vector<Individual> MakeGeneration(int number, const std::vector<double>& places) {
  std::vector<Individual> generation;
  for (const double place : places) {
    Individual individual;
    individual.number = 100 * number + static_cast<int>(generation.size());
    individual.generation = number;
    individual.genome = VectorXd::Constant(1, place);
    generation.push_back(individual);
  }
  return generation;
}

// Fitness is the place. Of eight two are simulated: those next to the best that is known. The others
// count less than these, whatever their surroundings promise.
TEST(Race, SimulatesWhereEarlierOnesWereGood) {
  Race race(MakeBox(1));
  std::vector<int> asked;
  const auto simulate = [&](const std::vector<Individual>& generation) {
    std::vector<double> fitness;
    for (const Individual& individual : generation) {
      asked.push_back(individual.number);
      fitness.push_back(individual.genome[0]);
    }
    return fitness;
  };
  race.Evaluate(MakeGeneration(0, {0.0}), simulate);
  race.Evaluate(MakeGeneration(1, {-0.9, -0.5, -0.1, 0.1, 0.5, 0.9}), simulate);
  EXPECT_EQ(asked.size(), 7u);
  asked.clear();
  const std::vector<double> fitness =
      race.Evaluate(MakeGeneration(2, {-0.8, 0.88, -0.6, -0.4, 0.0, 0.2, 0.91, 0.48}), simulate);
  EXPECT_EQ(asked, (std::vector<int>{201, 206}));
  EXPECT_EQ(fitness[1], 0.88);
  EXPECT_EQ(fitness[6], 0.91);
  for (const size_t i : {0, 2, 3, 4, 5, 7}) EXPECT_LT(fitness[i], 0.88);
}

}  // namespace
}  // namespace graspbench
