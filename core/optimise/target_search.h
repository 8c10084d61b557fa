#pragma once
/** @file
Step 2's questions to the simulation: an individual of the search as a grasp, its fitness, and which
individuals are worth more trials. Any search asks through it, so that methods are compared on the
same footing. */

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
  int number = 0;  ///< of the individual
  std::vector<LearningTrial> trials;
};

class TargetSearch {
 public:
  /** All references must outlive it. @pre the start brings its placement.
  @throws Error of the space. */
  TargetSearch(const Hand& hand, const GraspObject& object, const Grasp& start,
               const OptimiseConfig& config);
  TargetSearch(const TargetSearch&) = delete;
  TargetSearch& operator=(const TargetSearch&) = delete;

  const GraspSpace& space() const { return *space_; }
  /** That holds for the search [N]; of an equal grip known when the start was evaluated. */
  double grip_limit() const { return grip_limit_; }
  /** Of the search's random numbers. */
  RandomStream MakeStream() const;

  /** The fitness of each; the start, number 0, comes first of all. */
  std::vector<double> Evaluate(const std::vector<Individual>& generation,
                               const RunLearningTrials& run);

  /** Tries the individuals and sorts them: those that succeed most often first, among equals those
  of higher fitness. */
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

/** The fittest individuals, so many at most, that differ by 2 deg or more in some coordinate; never
the start. @param simulated  numbers of the included trials, rising. */
std::vector<Individual> FindCandidates(const SearchResult& search,
                                       const std::vector<int>& simulated, int most);

/** @throws Error when the space or the method cannot be used here: a grid of many coordinates. */
void CheckSearch(const Hand& hand, const GraspObject& object, const Grasp& start,
                 const OptimiseConfig& config);

}  // namespace graspbench
