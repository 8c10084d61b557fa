#pragma once
/** @file
Settings and terms of an optimisation, in one table each: its steps, the stages of its requests to
the simulation, and the variants of a grasp that it generates. */

#include <string>

#include "core/base/enum_table.h"
#include "core/base/text/json.h"
#include "core/optimise/grasp_space.h"

namespace graspbench {

struct OptimiseStepRow {
  const char* name;  ///< in files and options
  bool learns_pregrasp, searches_target;
};
inline constexpr OptimiseStepRow kOptimiseSteps[] = {
    {"1", true, false}, {"2", false, true}, {"both", true, true}};

/** Grip that a new target may use, so that it holds better and does not merely squeeze harder. */
enum class GripBudget { kFree, kEqual, kLimit };
struct GripBudgetRow {
  GripBudget value;
  const char* name;  ///< in files and options
  const char* words;
};
inline constexpr GripBudgetRow kGripBudgets[] = {
    {GripBudget::kFree, "free", "whatever it likes"},
    {GripBudget::kEqual, "equal", "as much as the search's start"},
    {GripBudget::kLimit, "limit", "as much as grip_limit_n says"},
};

/** Quantity that step 2 maximises (learning_trial.h). */
enum class FitnessKind { kSigma, kStrength };
struct FitnessKindRow {
  FitnessKind value;
  const char* name;  ///< in files and options
  const char* words;
};
inline constexpr FitnessKindRow kFitnessKinds[] = {
    {FitnessKind::kSigma, "sigma", "the stability sigma"},
    {FitnessKind::kStrength, "strength", "the smallest of six pulls that break the grasp"},
};

enum class LearningStage {
  kStandard,
  kOneShot,
  kTwoShot,
  kDelayed,
  kSearch,
  kScreening,
  kFinalist,
  kCheckBefore,
  kCheckAfter,
  kCheckAlone,
};
struct LearningStageRow {
  LearningStage value;
  const char* name;     ///< in files and reports
  bool has_individual;  ///< the request is about an individual of the search
};
inline constexpr LearningStageRow kLearningStages[] = {
    {LearningStage::kStandard, "standard", false},
    {LearningStage::kOneShot, "one-shot", false},
    {LearningStage::kTwoShot, "two-shot", false},
    {LearningStage::kDelayed, "delayed", false},
    {LearningStage::kSearch, "search", true},
    {LearningStage::kScreening, "screening", true},
    {LearningStage::kFinalist, "finalist", true},
    {LearningStage::kCheckBefore, "check before", false},
    {LearningStage::kCheckAfter, "check after", false},
    {LearningStage::kCheckAlone, "check without delays", false},
};

/** In the order in which they are generated; also an index. */
enum Variant { kStandardGrasp, kNewPreGrasp, kNewTarget };
struct VariantRow {
  Variant value;
  const char* name;   ///< in tables; for the two new ones also the grasp's id and file name
  const char* words;  ///< name in the thesis
};
inline constexpr VariantRow kVariants[] = {
    {kStandardGrasp, "standard", "standard grasp"},
    {kNewPreGrasp, "new-pregrasp", "new pre-grasp"},
    {kNewTarget, "new-target", "new target grasp"},
};
inline constexpr int kNumVariants = static_cast<int>(std::size(kVariants));
/** Variants that the optimisation generates. */
inline constexpr Variant kNewVariants[] = {kNewPreGrasp, kNewTarget};

/** Variant of a grasp id: that of a new variant, otherwise the standard grasp. */
inline Variant VariantOfGrasp(const std::string& grasp) {
  for (const Variant variant : kNewVariants) {
    if (grasp == RowOf(kVariants, variant).name) return variant;
  }
  return kStandardGrasp;
}

inline const char* NameOf(LearningStage stage) { return RowOf(kLearningStages, stage).name; }
inline const char* NameOf(Variant variant) { return RowOf(kVariants, variant).name; }
inline Json ToJson(Variant variant) { return NameOf(variant); }
inline const char* WordsOf(Variant variant) { return RowOf(kVariants, variant).words; }

struct OptimiseConfig {
  std::string step = "both";         ///< one of kOptimiseSteps
  std::string search = kThumbSpace;  ///< search space of step 2, see grasp_space.h
  std::string method = "es";         ///< search method of step 2, see search.h
  int evaluations = 1000;            ///< number of evaluations in step 2
  /** Trials per evaluation; 1: without variation; more: on as many draws. At the same number of
  trials, searches without variation found targets that hold better on unseen draws (README.md). */
  int fitness_trials = 1;
  bool race = false;              ///< skip the simulation of unpromising evaluations (Race)
  std::string fitness = "sigma";  ///< one of kFitnessKinds
  std::string grip = "equal";     ///< one of kGripBudgets
  double grip_limit = 0.0;        ///< for the grip "limit" [N]
  int choice_trials = 20;         ///< trials to compare pre-grasps, and the finalists of step 2
  int check_pairs = 100;          ///< most pairs of old and new grasp; 20 are one look
  int seed = 1;

  template <class V>
  void Visit(V&& v) {
    v("step", step, "1: new pre-grasp, 2: new target grasp, or both");
    v("search", search, "what step 2 changes: thumb, hand-pose, all-digits, synergy or closing");
    v("method", method, "search method of step 2: es, cmaes, de, random or grid");
    v("evaluations", evaluations, "grasps that step 2 tries");
    v("fitness_trials", fitness_trials, "trials of an evaluation; 1: without variation");
    v("race", race, "not all evaluations are simulated");
    v("fitness", fitness, "what a target is judged by: sigma or strength");
    v("grip", grip, "what a target may grip with: equal to the start, free, or limit");
    v("grip_limit_n", grip_limit, "for the grip limit: largest sum of normal forces");
    v("choice_trials", choice_trials, "draws by which pre-grasps and finalists are compared");
    v("check_pairs", check_pairs, "pairs of the old and the new grasp in the check, at most");
    v("seed", seed, "random seed of the search");
  }
};

/** @throws Error(kFormat) for a step that is not in the table. */
inline const OptimiseStepRow& StepsOf(const OptimiseConfig& config) {
  return RowFromName(kOptimiseSteps, config.step, "step");
}
/** The grip budget. @throws Error(kFormat) for one that is not in the table. */
inline const GripBudgetRow& GripOf(const OptimiseConfig& config) {
  return RowFromName(kGripBudgets, config.grip, "grip");
}
/** The fitness. @throws Error(kFormat) for one that is not in the table. */
inline const FitnessKindRow& FitnessOf(const OptimiseConfig& config) {
  return RowFromName(kFitnessKinds, config.fitness, "fitness");
}
inline bool FindsStrength(const OptimiseConfig& config) {
  return FitnessOf(config).value == FitnessKind::kStrength;
}

}  // namespace graspbench
