#include "core/optimise/methods/search.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <set>

#include "core/base/error.h"
#include "core/base/units.h"

namespace graspbench {
namespace {

using Eigen::VectorXd;
using Function = std::function<double(const VectorXd&)>;

SearchSpace MakeSpace(int size) {
  SearchSpace space;
  space.lower = VectorXd::Constant(size, -1.0);
  space.upper = VectorXd::Constant(size, 1.0);
  space.start = VectorXd::Constant(size, 0.7);
  space.step = 0.3;
  return space;
}

VectorXd Optimum(Eigen::Index size) { return VectorXd::LinSpaced(size, -0.4, 0.3); }

double Sphere(const VectorXd& x) { return -(x - Optimum(x.size())).squaredNorm(); }

/** Half-axes from 1 to 1000. */
double Ellipsoid(const VectorXd& x) {
  double sum = 0.0;
  const VectorXd d = x - Optimum(x.size());
  for (Eigen::Index i = 0; i < d.size(); ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(d.size() - 1);
    sum += std::pow(1000.0, share) * d[i] * d[i];
  }
  return -sum;
}

SearchResult Search(const std::string& method, int size, int num_evaluations, int seed,
                    const Function& function) {
  return RunSearch(method, MakeSpace(size), num_evaluations,
                   RandomStream(std::to_string(seed), "search test"),
                   [&](const std::vector<Individual>& generation) {
                     std::vector<double> fitness;
                     for (const Individual& individual : generation) {
                       fitness.push_back(function(individual.genome));
                     }
                     return fitness;
                   });
}

double FindBest(const SearchResult& result) { return result.individuals[result.best].fitness; }

double CalcMedianBest(const std::string& method, int size, const Function& function) {
  std::vector<double> best;
  for (int seed = 1; seed <= 11; ++seed) {
    best.push_back(FindBest(Search(method, size, 500, seed, function)));
  }
  std::sort(best.begin(), best.end());
  return best[5];
}

class LearningSearch : public testing::TestWithParam<const char*> {};

// Random search over the box finds the sphere's optimum within about 0.1 in 500 points of five
// coordinates; a method that learns must come much nearer.
TEST_P(LearningSearch, FindsTheOptimumAndBeatsRandomSearchInTheMedian) {
  for (const int size : {3, 5}) {
    for (const Function& function : {Function(Sphere), Function(Ellipsoid)}) {
      const double median = CalcMedianBest(GetParam(), size, function);
      EXPECT_LT(-median, 0.1 * -CalcMedianBest("random", size, function)) << size;
    }
    EXPECT_GT(CalcMedianBest(GetParam(), size, Sphere), -0.01) << size;
  }
}
INSTANTIATE_TEST_SUITE_P(Search, LearningSearch, testing::Values("es", "cmaes", "de"));

// Hansen's tutorial: on the sphere the distance falls by a constant factor per evaluation; about
// 10^-9 within some 100 n evaluations.
TEST(CmaEs, ConvergesLinearlyOnTheSphereAndLearnsTheEllipsoid) {
  EXPECT_GT(FindBest(Search("cmaes", 5, 1000, 1, Sphere)), -1e-12);
  EXPECT_GT(FindBest(Search("cmaes", 5, 2000, 1, Ellipsoid)), -1e-9);
}

class EverySearch : public testing::TestWithParam<const char*> {};

TEST_P(EverySearch, StaysInTheBoxAndKeepsTheBudget) {
  // The optimum lies in a corner, so every method is pushed against the box.
  const auto corner = [](const VectorXd& x) { return x.sum(); };
  const SearchResult result = Search(GetParam(), 3, 217, 3, corner);
  EXPECT_EQ(result.individuals.size(), 217u);
  for (size_t i = 0; i < result.individuals.size(); ++i) {
    const Individual& individual = result.individuals[i];
    EXPECT_EQ(individual.number, static_cast<int>(i));
    EXPECT_LE(individual.genome.maxCoeff(), 1.0);
    EXPECT_GE(individual.genome.minCoeff(), -1.0);
    for (const int parent : individual.parents) EXPECT_LT(parent, individual.number);
  }
  EXPECT_GE(FindBest(result), corner(MakeSpace(3).start));
  EXPECT_EQ(result.individuals.front().genome, MakeSpace(3).start);
}

TEST_P(EverySearch, IsTheSameForTheSameSeedAndGoesOnFromStoredFitness) {
  const SearchResult once = Search(GetParam(), 3, 130, 5, Ellipsoid);
  int num_asked = 0;
  // The second run gets the first half of its answers from the first run, as after an interruption.
  const SearchResult again =
      RunSearch(GetParam(), MakeSpace(3), 130, RandomStream("5", "search test"),
                [&](const std::vector<Individual>& generation) {
                  std::vector<double> fitness;
                  for (const Individual& individual : generation) {
                    const size_t number = static_cast<size_t>(individual.number);
                    EXPECT_EQ(individual.genome, once.individuals[number].genome);
                    fitness.push_back(number < 65 ? once.individuals[number].fitness
                                                  : Ellipsoid(individual.genome));
                    ++num_asked;
                  }
                  return fitness;
                });
  EXPECT_EQ(num_asked, static_cast<int>(once.individuals.size()));
  EXPECT_EQ(again.best, once.best);
  if (std::string(GetParam()) == "grid") return;
  EXPECT_NE(Search(GetParam(), 3, 130, 6, Ellipsoid).individuals[1].genome,
            once.individuals[1].genome);
}
INSTANTIATE_TEST_SUITE_P(Search, EverySearch,
                         testing::Values("es", "cmaes", "de", "random", "grid"));

TEST(EvolutionStrategy, NeverLosesTheBestAndRecombinesItsParents) {
  const SearchResult result = Search("es", 3, 401, 2, Ellipsoid);
  for (const Individual& child : result.individuals) {
    if (child.number == 0) continue;
    ASSERT_EQ(child.parents.size(), 2u);
    // Parents are among the five best of the last generation, or the best so far.
    int num_better = 0;
    double best_before = -1e9;
    for (const Individual& other : result.individuals) {
      if (other.generation < child.generation) best_before = std::max(best_before, other.fitness);
    }
    for (const int number : child.parents) {
      const Individual& parent = result.individuals[number];
      num_better = 0;
      for (const Individual& other : result.individuals) {
        num_better += other.generation == parent.generation && other.fitness > parent.fitness;
      }
      EXPECT_TRUE(num_better < 5);
      EXPECT_TRUE(parent.generation == child.generation - 1 || parent.fitness == best_before);
    }
  }
}

// 5^2 <= 30 < 6^2: five points each, one apart.
TEST(GridSearch, GivesEveryPointOfTheLatticeOnceAndThenNoMore) {
  const SearchSpace space = {VectorXd::Constant(2, -1.0), VectorXd::Constant(2, 3.0),
                             VectorXd::Zero(2)};
  const auto search = MakeSearchMethod("grid", space, 31, RandomStream("none", "test"));
  std::set<std::array<double, 2>> points, lattice;
  size_t count = 0;
  for (auto generation = search->MakeGeneration(); !generation.empty();
       generation = search->MakeGeneration()) {
    for (const Individual& individual : generation) {
      points.insert({individual.genome[0], individual.genome[1]});
      ++count;
    }
  }
  for (int i = -1; i <= 3; ++i) {
    for (int j = -1; j <= 3; ++j) lattice.insert({double(i), double(j)});
  }
  EXPECT_EQ(points, lattice);
  EXPECT_EQ(count, lattice.size());
}

TEST(RandomSearch, FillsTheBoxEvenly) {
  const SearchSpace space = {Eigen::Vector2d(-1.0, 10.0), Eigen::Vector2d(3.0, 11.0),
                             Eigen::Vector2d(0.0, 10.5)};
  const auto search = MakeSearchMethod("random", space, 0, RandomStream("box", "test"));
  Eigen::Array2d sum = Eigen::Array2d::Zero(), squares = Eigen::Array2d::Zero();
  int count = 0;
  while (count < 4000) {
    for (const Individual& individual : search->MakeGeneration()) {
      const Eigen::Array2d share =
          (individual.genome - space.lower).array() / (space.upper - space.lower).array();
      ASSERT_TRUE((share >= 0.0).all() && (share < 1.0).all());
      sum += share;
      squares += share.square();
      ++count;
    }
  }
  // Uniform: mean 1/2, mean square 1/3; four standard errors.
  const double root = std::sqrt(static_cast<double>(count));
  for (int i = 0; i < 2; ++i) {
    EXPECT_NEAR(sum[i] / count, 0.5, 4.0 * std::sqrt(1.0 / 12.0) / root);
    EXPECT_NEAR(squares[i] / count, 1.0 / 3.0, 4.0 * std::sqrt(4.0 / 45.0) / root);
  }
}

TEST(Search, RefusesWhatItCannotDo) {
  const auto find_error = [](const std::string& method, int size, int evaluations) {
    try {
      Search(method, size, evaluations, 1, Sphere);
    } catch (const Error& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  EXPECT_EQ(
      find_error("grid", 5, 1000),
      "a grid is possible for at most three coordinates, this search has 5; choose another method");
  EXPECT_EQ(find_error("grid", 3, 8), "a grid needs at least 9 evaluations");
  EXPECT_EQ(find_error("cmas", 3, 8).substr(0, 46),
            "no search method \"cmas\"; did you mean \"cmaes\"?");
}

TEST(ReflectInto, MirrorsAtTheFaces) {
  const SearchSpace space = MakeSpace(1);
  const auto reflect = [&](double x) { return ReflectInto(space, VectorXd::Constant(1, x))[0]; };
  EXPECT_NEAR(reflect(0.3), 0.3, 1e-15);
  EXPECT_NEAR(reflect(1.2), 0.8, 1e-15);
  EXPECT_NEAR(reflect(-1.5), -0.5, 1e-15);
  EXPECT_NEAR(reflect(3.1), -0.9, 1e-15);
}

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
  const Individual& best = result.individuals[result.best];
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
