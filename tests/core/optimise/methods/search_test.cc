#include "core/optimise/methods/search.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "core/base/error.h"

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

double FindBest(const SearchResult& result) {
  return result.individuals[static_cast<size_t>(result.best)].fitness;
}

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
      const Individual& parent = result.individuals[static_cast<size_t>(number)];
      num_better = 0;
      for (const Individual& other : result.individuals) {
        num_better += other.generation == parent.generation && other.fitness > parent.fitness;
      }
      EXPECT_TRUE(num_better < 5);
      EXPECT_TRUE(parent.generation == child.generation - 1 || parent.fitness == best_before);
    }
  }
}

TEST(GridSearch, CoversTheFacesOfTheBox) {
  const SearchResult result = Search("grid", 3, 65, 1, Sphere);
  ASSERT_EQ(result.individuals.size(), 65u);  // the start and 4 x 4 x 4
  EXPECT_EQ(result.individuals[1].genome, VectorXd::Constant(3, -1.0));
  EXPECT_EQ(result.individuals[64].genome, VectorXd::Constant(3, 1.0));
  EXPECT_NEAR(result.individuals[2].genome[0], -1.0 / 3.0, 1e-15);
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

}  // namespace
}  // namespace graspbench
