#pragma once
/** @file
The settings of an optimisation. */

#include <string>

#include "core/optimise/optimise_steps.h"
#include "core/optimise/spaces/grasp_space.h"

namespace graspbench {

struct OptimiseConfig {
  std::string step = "both";         ///< of kOptimiseSteps
  std::string search = kThumbSpace;  ///< what step 2 changes, see grasp_space.h
  std::string method = "es";         ///< of step 2, see search.h
  int evaluations = 1000;            ///< of step 2
  /** Per evaluation; 1: without variation, more: so many drawn ones. At the same number of trials
  the one without variation found targets that hold better on unseen draws (README.md). */
  int fitness_trials = 1;
  bool race = false;              ///< not all are simulated (methods/race.h)
  std::string fitness = "sigma";  ///< of kFitnessKinds
  std::string grip = "equal";     ///< of kGripBudgets
  double grip_limit = 0.0;        ///< for the grip "limit" [N]
  int choice_trials = 20;         ///< by which pre-grasps, and step 2's finalists, are compared
  int check_pairs = 100;          ///< of the old and the new grasp, at most; 20 are one look
  int seed = 1;

  template <class V>
  void Visit(V&& v) {
    v("step", step);
    v("search", search);
    v("method", method);
    v("evaluations", evaluations);
    v("fitness_trials", fitness_trials);
    v("race", race);
    v("fitness", fitness);
    v("grip", grip);
    v("grip_limit_n", grip_limit);
    v("choice_trials", choice_trials);
    v("check_pairs", check_pairs);
    v("seed", seed);
  }
};

/** @throws Error(kFormat) for a step that is not in the table. */
inline const OptimiseStepRow& StepsOf(const OptimiseConfig& config) {
  return RowFromName(kOptimiseSteps, config.step, "step");
}
/** The same for its grip. */
inline const GripBudgetRow& GripOf(const OptimiseConfig& config) {
  return RowFromName(kGripBudgets, config.grip, "grip");
}
/** The same for its fitness. */
inline const FitnessKindRow& FitnessOf(const OptimiseConfig& config) {
  return RowFromName(kFitnessKinds, config.fitness, "fitness");
}
inline bool FindsStrength(const OptimiseConfig& config) {
  return FitnessOf(config).value == FitnessKind::kStrength;
}

}  // namespace graspbench
