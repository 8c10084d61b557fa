#pragma once
/** @file
Summary of a campaign's stored results, computed once for the terminal, JSON and the report. Each
scene has three variants of its grasp, simulated on the same object poses, so that trials of the
same number are pairs.

A cell's value of a measure is the mean over its trials if every trial has the measure (success,
sigma, breaking force), else the median over the trials that have it. GFT% and GOT% are medians over
all trials, as in the optimisation: a trial in which a digit never touched counts as infinite. */

#include <array>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "core/base/text/record_fields.h"
#include "core/base/units.h"
#include "core/optimise/optimise_config.h"
#include "core/statistics/bootstrap.h"
#include "core/statistics/proportion.h"
#include "datasets/analysis/session_summary.h"
#include "datasets/campaign/campaign_store.h"

namespace graspbench {

/** A quantity of a trial by which variants are compared; one line in ListVariantMeasures. */
struct VariantMeasure {
  const char* name;     ///< with unit: "GFT% [%]"
  const char* meaning;  ///< one sentence
  double unit;          ///< displayed number = unit * value
  int decimals;
  bool is_larger_better;
  enum CellValue { kMean, kMedianOfHaving, kMedianMissingIsInfinite } of_cell;
  std::function<double(const TrialRecord&)> value;  ///< NaN: undefined in this trial
};
const std::vector<VariantMeasure>& ListVariantMeasures();
/** Finds a measure by its name without unit: "sigma". @pre it exists. */
const VariantMeasure& FindVariantMeasure(const std::string& name);

struct SceneVariants {
  const SceneRecord* scene = nullptr;
  std::string hand, object, grasp;                       ///< ids; of the standard grasp
  std::string key;                                       ///< id without blanks: "tum-can"
  std::array<const CellSummary*, kNumVariants> cells{};  ///< null: not simulated
  const CellSummary& cell(Variant variant) const { return *cells[variant]; }
  bool IsComplete() const;  ///< all variants have a finished trial
};

/** Returns a cell's value of a measure; NaN if no trial has it, or half of them or more are
infinite. */
double CalcCellValue(const VariantMeasure& measure, const CellSummary& cell);

/** Lists the differences b - a over trials that have the measure under both variants. */
std::vector<double> ListPairedDifferences(const VariantMeasure& measure, const SceneVariants& scene,
                                          Variant a, Variant b);
struct PairedDifference {
  int num_pairs = 0;
  double mean = kUnset;                ///< NaN without a pair
  Answer<BootstrapInterval> interval;  ///< of the mean
};
PairedDifference CalcPairedDifference(const VariantMeasure& measure, const SceneVariants& scene,
                                      Variant a, Variant b);

/** Counts the scenes in which all variants have a finished trial. */
int CountComplete(const std::vector<SceneVariants>& scenes);

/** Effect of an optimisation step on the cells' values of a measure. */
struct StepEffect {
  int num_scenes = 0;
  double median_before = 0.0, median_after = 0.0;
  Answer<BootstrapInterval> ratio;          ///< of the medians, after / before
  std::vector<const SceneVariants*> worse;  ///< scenes whose value is worse after the step

  double plain_ratio() const { return median_after / median_before; }
  double share_worse() const { return CalcShare(static_cast<int64_t>(worse.size()), num_scenes); }
};
/** Computes the effect over the scenes in which both variants have a value; an empty hand means all
hands. */
StepEffect CalcStepEffect(const VariantMeasure& measure, const std::vector<SceneVariants>& scenes,
                          Variant a, Variant b, const std::string& hand = {});

/** Counts successes in pairs of trials of the same number, those of `a` first. @pre both variants
were simulated. */
PairedCounts CountPairedSuccesses(const SceneVariants& scene, Variant a, Variant b);

/** A scene in which a variant succeeds less often on the same draws. */
struct LowerSuccess {
  const SceneVariants* scene = nullptr;
  PairedCounts counts;
  double p_holm = kUnset;  ///< McNemar's exact test, Holm over the scenes
};
/** Lists scenes in which `b` succeeds less often than `a` with p_holm < 0.05. */
std::vector<LowerSuccess> ListSignificantlyLower(const std::vector<SceneVariants>& scenes,
                                                 Variant a, Variant b);

/** Totals of a variant: trial counts, and medians over the scenes' values. */
struct VariantTotal {
  Variant variant = kStandardGrasp;
  int num_scenes = 0;
  int trials = 0, successes = 0;
  double median_sigma = kUnset;
  double median_gft_ratio = kUnset, median_gft_floor = kUnset;  ///< of GFT%: value, floor
  double median_got_ratio = kUnset;
  double median_gft = kUnset, median_got = kUnset, median_gct = kUnset;  ///< [s]
};
std::vector<VariantTotal> ListVariantTotals(const Campaign& campaign);

/** A search method over all scenes and seeds of the comparison. */
struct MethodTotal {
  std::string method;
  int num_searches = 0;
  double median_best_fitness = kUnset;
  int num_reached_90 = 0;
  double median_evaluations_to_90 = kUnset;  ///< of the searches that reached it
};
/** Lists the methods' totals; empty if no methods were compared. */
std::vector<MethodTotal> ListMethodTotals(const Campaign& campaign);

/** GFT% of the pre-grasp before and after step 1 in a trial without variation of object pose or
hand, over the scenes in which all digits touch both times. */
struct GftWithoutVariation {
  int num_scenes = 0;
  double median_before = kUnset, median_after = kUnset;
};
GftWithoutVariation CalcGftWithoutVariation(const std::vector<SceneVariants>& scenes);

/** A variant's values for two hands on the objects that both grasped. */
struct HandComparison {
  int num_objects = 0;
  double median_a = kUnset, median_b = kUnset;
  int num_a_better = 0, num_b_better = 0;
};
HandComparison CompareHands(const VariantMeasure& measure, const std::vector<SceneVariants>& scenes,
                            Variant variant, const std::string& hand_a, const std::string& hand_b);

/** Returns the complete scene of a hand and an object; null if there is none. */
const SceneVariants* FindScene(const std::vector<SceneVariants>& scenes, const std::string& hand,
                               const std::string& object);

/** Lists all scenes in the campaign's order. The result points into the arguments. */
std::vector<SceneVariants> ListScenes(const Campaign& campaign, const SessionSummary& benchmark);

/** A search method on one scene of the comparison, over its seeds. */
struct MethodCurve {
  std::string hand, object, method;
  int num_seeds = 0;
  std::vector<double> evaluations;        ///< 1, 2, ...
  std::vector<double> low, median, high;  ///< quartiles of the best fitness so far
  double final_median = 0.0;
  double median_evaluations_to_90 = 0.0;  ///< NaN: most seeds never reached it
};
/** Lists the curves in the order of scenes and methods of the stored runs; those of a scene are
consecutive. */
std::vector<MethodCurve> ListMethodCurves(const Campaign& campaign);

/** Number of scenes in which one method's median over seeds ends above another's. */
struct MethodDuel {
  int num_scenes = 0, num_won = 0;
  double share_won() const { return CalcShare(num_won, num_scenes); }
};
MethodDuel CompareMethods(const std::vector<MethodCurve>& curves, const std::string& method,
                          const std::string& other);

/* A campaign's tables in its folder: summary.csv with one line per cell of the benchmark, and
comparison.csv with one line per search of the comparison. */

/** Summary of the benchmark's trials of one scene and variant. */
struct VariantSummary {
  std::string hand, object, grasp;
  Variant variant = kStandardGrasp;
  int trials = 0;
  int successes = 0;
  double mean_sigma = kUnset;  ///< [N]
  double median_gft_ratio = kUnset;
  double gft_ratio_floor = kUnset;
  double median_got_ratio = kUnset;
  double median_gft = kUnset, median_got = kUnset, median_gct = kUnset;  ///< [s]
  double mean_breaking_force = kUnset;                                   ///< [N]
  double median_grip = kUnset;                                           ///< [N]
  double median_sigma_ratio = kUnset;                                    ///< of the grip
  double median_breaking_ratio = kUnset;                                 ///< of the grip
  double headroom_share = kUnset;  ///< of step 2's start or accepted grasp (headrooms.h)

  template <class V>
  static void ListFields(V&& field) {
    using S = VariantSummary;
    field("hand", &S::hand, FieldColumn{"", "id of the hand"});
    field("object", &S::object, FieldColumn{"", "id of the object"});
    field("grasp", &S::grasp, FieldColumn{"", "id of the grasp"});
    field("variant", &S::variant, FieldColumn{"", "standard, new-pregrasp or new-target"});
    field("trials", &S::trials, FieldColumn{"", "finished trials"});
    field("successes", &S::successes, FieldColumn{"", "those that succeeded"});
    field("mean_sigma", &S::mean_sigma, FieldColumn{"N", "a trial without sigma counts 0"});
    field("median_gft_ratio", &S::median_gft_ratio,
          FieldColumn{"", "a trial in which a digit never touched counts as infinite"});
    field("gft_ratio_floor", &S::gft_ratio_floor,
          FieldColumn{"", "of GFT%, were only the trials' scatter left; empty: none"});
    field("median_got_ratio", &S::median_got_ratio, FieldColumn{"", "as of GFT%"});
    field("median_gft_s", &S::median_gft,
          FieldColumn{"s", "of the trials in which every digit touched"});
    field("median_got_s", &S::median_got,
          FieldColumn{"s", "of the trials in which thumb and another digit touched"});
    field("median_gct_s", &S::median_gct,
          FieldColumn{"s", "of the trials in which every digit touched"});
    field("mean_breaking_force_n", &S::mean_breaking_force,
          FieldColumn{"N", "of the judged trials; a lost object counts 0"});
    field("median_grip_n", &S::median_grip,
          FieldColumn{"N", "sum of the hand's normal forces in the hold"});
    field("median_sigma_per_grip", &S::median_sigma_ratio, FieldColumn{"", "of what was held"});
    field("median_breaking_per_grip", &S::median_breaking_ratio,
          FieldColumn{"", "of what was held and judged"});
    field(
        "headroom_share", &S::headroom_share,
        FieldColumn{"",
                    "of mu N - m g, borne in step 2's check: of the new pre-grasp, its start, and "
                    "of the new target, what it kept; empty: none"});
  }
};
std::vector<VariantSummary> SummariseVariants(const Campaign& campaign);

/** Writes summary.csv and, if methods were compared, comparison.csv, and seals them in the
campaign's manifest.
@throws Error(kIo). */
void ExportCampaign(const std::filesystem::path& folder, const Campaign& campaign);
/** The data dictionaries of summary.csv and comparison.csv. */
///@{
Json MakeVariantSchema();
Json MakeComparisonSchema();
///@}

}  // namespace graspbench
