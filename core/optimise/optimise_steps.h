#pragma once
/** @file
The terms of the optimisation, one table each: its steps, the stages in which it asks the simulation
something, and the variants of a grasp that it makes. */

#include <string>

#include "core/base/enum_table.h"
#include "core/base/text/json.h"

namespace graspbench {

struct OptimiseStepRow {
  const char* name;  ///< in files and options
  bool learns_pregrasp, searches_target;
};
inline constexpr OptimiseStepRow kOptimiseSteps[] = {
    {"1", true, false}, {"2", false, true}, {"both", true, true}};

/** What a new target may grip with, so that it holds better and does not only squeeze harder. */
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

/** What step 2 makes larger (learning_trial.h). */
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
};
struct LearningStageRow {
  LearningStage value;
  const char* name;     ///< in files and for people
  bool has_individual;  ///< asks about an individual of the search
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
};

/** In the order of their making; also an index. */
enum Variant { kStandardGrasp, kNewPreGrasp, kNewTarget };
struct VariantRow {
  Variant value;
  const char* name;   ///< in tables; of the two new ones also the grasp's id and its file's name
  const char* words;  ///< the name of the thesis
};
inline constexpr VariantRow kVariants[] = {
    {kStandardGrasp, "standard", "standard grasp"},
    {kNewPreGrasp, "new-pregrasp", "new pre-grasp"},
    {kNewTarget, "new-target", "new target grasp"},
};
inline constexpr int kNumVariants = static_cast<int>(std::size(kVariants));
/** What the optimisation makes. */
inline constexpr Variant kNewVariants[] = {kNewPreGrasp, kNewTarget};

/** Of grasp ids: those of the new variants, else the standard grasp. */
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

}  // namespace graspbench
