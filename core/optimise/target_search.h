#pragma once
/** @file
Requests of step 2 to the simulation: conversion of an individual to a grasp, its fitness, and the
choice of individuals for more trials. All search methods use it, so that they are comparable. */

#include <memory>
#include <vector>

#include "core/base/random.h"
#include "core/grasp/standard_grasp.h"
#include "core/optimise/grasp_check.h"
#include "core/optimise/learning_trial.h"
#include "core/optimise/methods/search.h"
#include "core/optimise/optimise_config.h"

namespace graspbench {

struct Finalist {
  int number = 0;  ///< number of the individual
  std::vector<LearningTrial> trials;
};

class TargetSearch {
 public:
  /** All references must outlive this object. @pre the start has a placement.
  @throws Error of the space. */
  TargetSearch(const Hand& hand, const GraspObject& object, const Grasp& start,
               const OptimiseConfig& config);
  TargetSearch(const TargetSearch&) = delete;
  TargetSearch& operator=(const TargetSearch&) = delete;

  const GraspSpace& space() const { return *space_; }
  /** Grip that the search may use [N]; for an equal grip, known once the start was evaluated. */
  double grip_limit() const { return grip_limit_; }
  /** Random numbers of the search. */
  RandomStream MakeStream() const;

  /** Returns the fitness of each individual; the start, number 0, must be evaluated first. */
  std::vector<double> Evaluate(const std::vector<Individual>& generation,
                               const RunLearningTrials& run);

  /** Evaluates the individuals and sorts them by number of successes, then by fitness. */
  std::vector<Finalist> Rank(LearningStage stage, const std::vector<Individual>& individuals,
                             const std::vector<int>& draws, const RunLearningTrials& run) const;

 private:
  LearningRequest MakeRequest(LearningStage stage, const Individual& individual,
                              const std::vector<int>& draws) const;

  const Hand& hand_;
  const GraspObject& object_;
  const OptimiseConfig& config_;
  std::unique_ptr<GraspSpace> space_;
  double grip_limit_ = kAnyGrip;
};

/** Returns the `most` fittest individuals that differ by 2 deg or more in some coordinate, without
the start. @param simulated  numbers of the simulated individuals, ascending. */
std::vector<Individual> FindCandidates(const SearchResult& search,
                                       const std::vector<int>& simulated, int most);

/** @throws Error if the space or the method is unusable here, e.g. a grid of many coordinates. */
void CheckSearch(const Hand& hand, const GraspObject& object, const Grasp& start,
                 const OptimiseConfig& config);

}  // namespace graspbench
