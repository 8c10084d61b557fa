#pragma once
/** @file
Search for the best point of a box: a common interface for the evolution strategy and the methods
with which it is compared, at the same number of evaluations.

A method generates and learns from whole generations, so that the points of one generation can be
evaluated in parallel. A stopped search resumes when it is given the stored fitness values again:
the same stream and fitness lead to the same points. The start is always evaluated first, so no
search ends below it.

    es      evolution strategy
    cmaes   covariance matrix adaptation
    de      differential evolution
    random  uniform in the box
    grid    equal distances in each coordinate; at most three coordinates

A library such as pagmo was considered. It evaluates inside its own loop, so generations could
neither be run in parallel nor resumed, and each method takes fewer than a hundred lines. */

#include <Eigen/Core>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/base/random.h"
#include "core/base/text/record_fields.h"

namespace graspbench {

struct SearchSpace {
  Eigen::VectorXd lower;  ///< by coordinate
  Eigen::VectorXd upper;  ///< >= lower
  Eigen::VectorXd start;  ///< within the box
  double step = 0.0;      ///< initial standard deviation of a change, in units of the coordinates

  int size() const { return static_cast<int>(start.size()); }
};

struct Individual {
  int number = 0;            ///< in order of creation; 0 is the start
  int generation = 0;        ///< 0: the start
  std::vector<int> parents;  ///< numbers; empty if the method has none
  Eigen::VectorXd genome;    ///< within the box
  Eigen::VectorXd steps;     ///< self-adapted standard deviations; empty if the method has none
  double fitness = 0.0;      ///< larger is better; valid after evaluation

  /** Field names of journals, where the coordinates are in radians (grasp_space.h). */
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
  /** Creates the next generation, with parents, genomes and steps. */
  virtual std::vector<Individual> MakeGeneration() = 0;
  /** @param generation  that of MakeGeneration, evaluated; initially the start only. */
  virtual void Learn(const std::vector<Individual>& generation) = 0;
};

/** Methods in their own files. @param num_evaluations  total number of evaluations. */
///@{
std::unique_ptr<SearchMethod> MakeEvolutionStrategy(const SearchSpace& space, int num_evaluations,
                                                    RandomStream stream);
std::unique_ptr<SearchMethod> MakeCmaEs(const SearchSpace& space, int num_evaluations,
                                        RandomStream stream);
std::unique_ptr<SearchMethod> MakeDifferentialEvolution(const SearchSpace& space,
                                                        int num_evaluations, RandomStream stream);
///@}

/** Names of all methods: "es", "cmaes", ... */
const std::vector<std::string>& ListSearchMethods();

/** @param num_evaluations  total number of evaluations.
@throws Error(kNotFound) for an unknown name; Error(kUnsupported) for a grid of more than three
coordinates. */
std::unique_ptr<SearchMethod> MakeSearchMethod(const std::string& name, const SearchSpace& space,
                                               int num_evaluations, RandomStream stream);

/** Returns the fitness of each individual. */
using EvaluateGeneration = std::function<std::vector<double>(const std::vector<Individual>&)>;

struct SearchResult {
  std::vector<Individual> individuals;  ///< all that were evaluated, by number
  int best = 0;                         ///< number of the fittest, the first of equals
};

/** Evaluates exactly `num_evaluations` >= 1 points (fewer if a grid has fewer); the last generation
is truncated. */
SearchResult RunSearch(const std::string& method, const SearchSpace& space, int num_evaluations,
                       RandomStream stream, const EvaluateGeneration& evaluate);

Eigen::VectorXd DrawUniformPoint(const SearchSpace& space, RandomStream& stream);
/** Mirrors a point at the faces of the box until it is inside. */
Eigen::VectorXd ReflectInto(const SearchSpace& space, Eigen::VectorXd point);

/** Reduces the simulations of a generation: only the individuals that earlier evaluations predict
to be best are simulated, the others get their prediction as fitness. The prediction is the mean of
the five nearest simulated individuals, weighted by the inverse square of their distance in the box
(Shepard 1968). Choosing by it before a costly evaluation is pre-selection (Jin, Swarm and
Evolutionary Computation 1:61, 2011). It costs no simulation. All of the first two generations,
including the start, are simulated, then kRacedShare of each.

The fitness of an individual that was not simulated is below the worst that was simulated in its
generation, so that it becomes a parent only after those. Deterministic: the same fitness leads to
the same requests, so a stopped race resumes like a search. Not found: good regions far from all
simulated points, which look only as good as their surroundings. */
class Race {
 public:
  static constexpr double kRacedShare = 0.28;

  explicit Race(const SearchSpace& space) : space_(space) {}

  /** @param simulate  is called for part of the generation, in its order.
  @returns the fitness of each individual of the generation. */
  std::vector<double> Evaluate(const std::vector<Individual>& generation,
                               const EvaluateGeneration& simulate);

 private:
  double Promise(const Eigen::VectorXd& genome) const;

  SearchSpace space_;
  std::vector<Individual> known_;  // simulated
};

}  // namespace graspbench
