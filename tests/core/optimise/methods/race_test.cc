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

// By hand: the five nearest are 0.1 .. 0.5 of the box away and have the fitness 1 .. 5; a sixth,
// which was there first, is farther. What was given up has its promise, or less than what was
// simulated.
TEST(Race, APromiseIsTheWeightedMeanOfTheFiveNearest) {
  SearchSpace box = MakeBox(2);
  box.lower[1] = -10.0;
  box.upper[1] = 10.0;
  const auto make = [](int generation, const std::vector<Eigen::Vector2d>& places) {
    std::vector<Individual> individuals;
    for (const Eigen::Vector2d& place : places) {
      Individual individual;
      individual.number = static_cast<int>(individuals.size());
      individual.generation = generation;
      individual.genome = place;
      individuals.push_back(individual);
    }
    return individuals;
  };
  Race race(box);
  size_t num_asked = 0;
  const auto answer = [&](const std::vector<double>& fitness) {
    return [&num_asked, fitness](const std::vector<Individual>& generation) {
      num_asked = generation.size();
      return std::vector<double>(fitness.begin(),
                                 fitness.begin() + static_cast<std::ptrdiff_t>(num_asked));
    };
  };
  race.Evaluate(make(0, {{1.0, 10.0}}), answer({-1000.0}));
  race.Evaluate(make(1, {{0.2, 0.0}, {-0.4, 0.0}, {0.0, 6.0}, {0.8, 0.0}, {0.0, -10.0}}),
                answer({1.0, 2.0, 3.0, 4.0, 5.0}));
  EXPECT_EQ(num_asked, 5u);
  const std::vector<double> fitness = race.Evaluate(
      make(2, {{0.0, 0.0}, {0.3, 0.0}, {0.0, -9.9}, {0.1, 0.0}}), answer({1e6, 1e6, 1e6, 1e6}));
  EXPECT_EQ(num_asked, 1u);
  EXPECT_EQ(fitness[2], 1e6);
  const double sum = 1.0 / 0.01 + 2.0 / 0.04 + 3.0 / 0.09 + 4.0 / 0.16 + 5.0 / 0.25;
  const double weights = 1.0 / 0.01 + 1.0 / 0.04 + 1.0 / 0.09 + 1.0 / 0.16 + 1.0 / 0.25;
  EXPECT_NEAR(fitness[0], sum / weights, 1e-9);
  // Of two, too, one is simulated.
  const std::vector<double> worse =
      race.Evaluate(make(3, {{0.0, 0.0}, {0.0, -9.9}}), answer({-5.0}));
  EXPECT_EQ(num_asked, 1u);
  EXPECT_EQ(worse[1], -5.0);
  EXPECT_LT(worse[0], -5.0);
}

}  // namespace
}  // namespace graspbench
