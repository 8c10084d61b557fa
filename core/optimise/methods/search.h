#pragma once
/** @file
Search for the best point of a box: one interface for the evolution strategy and for the methods it
is compared with, at the same number of evaluations.

A method makes whole generations and learns from whole generations, so that the points of one
generation can be evaluated at the same time and a stopped search goes on when the stored fitness
values are given to it again: same stream, same fitness, same points. The start is always evaluated
first, so no search ends below it.

    es      evolution strategy
    cmaes   covariance matrix adaptation
    de      differential evolution
    random  uniform in the box
    grid    equal distances in each coordinate; at most three coordinates

A library such as pagmo was considered: it evaluates inside its own loop, so generations could
neither be run in parallel nor resumed, and each method is less than a hundred lines. */

#include <Eigen/Core>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/base/random.h"
#include "core/base/text/record_fields.h"

namespace graspbench {

struct SearchSpace {
  Eigen::VectorXd lower;  ///< of each coordinate
  Eigen::VectorXd upper;  ///< >= lower
  Eigen::VectorXd start;  ///< within
  double step = 0.0;      ///< first standard deviation of a change, in the unit of the coordinates

  int size() const { return static_cast<int>(start.size()); }
};

struct Individual {
  int number = 0;            ///< in the order of their making; 0 is the start
  int generation = 0;        ///< 0: the start
  std::vector<int> parents;  ///< numbers; empty where the method has none
  Eigen::VectorXd genome;    ///< within the box
  Eigen::VectorXd steps;     ///< self-adapted standard deviations; empty where the method has none
  double fitness = 0.0;      ///< larger is better; meaningful when evaluated

  /** As in journals, where the coordinates are in radians (grasp_space.h). */
  template <class V>
  static void ListFields(V&& field) {
    field("number", &Individual::number);
    field("generation", &Individual::generation);
    field("parents", &Individual::parents);
    field("genome_rad", &Individual::genome);
    field("steps_rad", &Individual::steps);
    field("fitness", &Individual::fitness);
  }
};

class SearchMethod {
 public:
  virtual ~SearchMethod() = default;
  /** Parents, genomes and steps of the next generation. */
  virtual std::vector<Individual> MakeGeneration() = 0;
  /** @param generation  what MakeGeneration gave, evaluated; at first the start alone. */
  virtual void Learn(const std::vector<Individual>& generation) = 0;
};

/** The methods of files of their own. @param num_evaluations  how many there will be in all. */
///@{
std::unique_ptr<SearchMethod> MakeEvolutionStrategy(const SearchSpace& space, int num_evaluations,
                                                    RandomStream stream);
std::unique_ptr<SearchMethod> MakeCmaEs(const SearchSpace& space, int num_evaluations,
                                        RandomStream stream);
std::unique_ptr<SearchMethod> MakeDifferentialEvolution(const SearchSpace& space,
                                                        int num_evaluations, RandomStream stream);
///@}

/** "es", "cmaes", ...: all. */
const std::vector<std::string>& ListSearchMethods();

/** @param num_evaluations  how many there will be in all.
@throws Error(kNotFound) for an unknown name; Error(kUnsupported) for a grid of more than three
coordinates. */
std::unique_ptr<SearchMethod> MakeSearchMethod(const std::string& name, const SearchSpace& space,
                                               int num_evaluations, RandomStream stream);

/** The fitness of each individual. */
using EvaluateGeneration = std::function<std::vector<double>(const std::vector<Individual>&)>;

struct SearchResult {
  std::vector<Individual> individuals;  ///< all evaluated ones, by number
  int best = 0;                         ///< the first of the fittest
};

/** Evaluates exactly `num_evaluations` >= 1 points (fewer when a grid has fewer): the last
generation is cut. */
SearchResult RunSearch(const std::string& method, const SearchSpace& space, int num_evaluations,
                       RandomStream stream, const EvaluateGeneration& evaluate);

Eigen::VectorXd DrawUniformPoint(const SearchSpace& space, RandomStream& stream);
/** Points outside are mirrored at the box's faces until they are inside. */
Eigen::VectorXd ReflectInto(const SearchSpace& space, Eigen::VectorXd point);

/** Races the individuals of a generation: those are simulated of which earlier evaluations promise
most, the others are given up for what is promised of them. A promise is the mean of the five
nearest simulated individuals, weighted by the inverse square of their distance in the box
(Shepard 1968); choosing by it before a costly evaluation is pre-selection (Jin, Swarm and
Evolutionary Computation 1:61, 2011). Costs no simulation. All of the first two generations are
simulated, the start among them, then kRacedShare of each.

One that was given up counts less than the worst that was simulated of its generation, so that it is
no parent before those. Deterministic: the same fitness leads to the same questions, so a stopped
race goes on as a search does. Blind to: good places far from all that was simulated, which only
look as good as their surroundings. */
class Race {
 public:
  static constexpr double kRacedShare = 0.28;

  explicit Race(const SearchSpace& space) : space_(space) {}

  /** @param simulate  is asked for a part of the generation, in its order.
  @returns the fitness of each of the generation. */
  std::vector<double> Evaluate(const std::vector<Individual>& generation,
                               const EvaluateGeneration& simulate);

 private:
  double Promise(const Eigen::VectorXd& genome) const;

  SearchSpace space_;
  std::vector<Individual> known_;  // simulated
};

}  // namespace graspbench
