#pragma once
/** @file
What the factors of a sweep (datasets/plan/conditions.h) change, on the same draws.

A draw is one hand, object and number; y(c) is a measure of its trial under the condition c. The
effect of a level l of the factor A, of a draw: the mean of

    y(c') - y(c)    over all pairs of conditions that differ in A alone, l in c' and the base in c,

and where a design has no such pair (Latin hypercubes) the mean over all c' with l less that over all
c with the base's level. The interaction of two levels l and m of A and B: the mean of

    y(l, m) - y(l, 0) - y(0, m) + y(0, 0)    over all such four conditions.

Estimates are means over draws, of those that have every value; each says how many planned draws it
leaves out, and why. Draws, estimates and intervals are those of datasets/analysis/pairs.h. Many
intervals are shown: one in twenty misses 0 by chance. Of a grip threshold y is its binary
logarithm. */

#include <array>
#include <string>
#include <vector>

#include "datasets/analysis/conditions/threshold_summary.h"
#include "datasets/analysis/pairs.h"
#include "datasets/plan/conditions.h"
#include "datasets/session/session_store.h"

namespace graspbench {

/* What a sweep compares (sweep_summary.h) of its trials.

A grip threshold (threshold_summary.h) enters effects as its binary logarithm, because its scale has
equal ratios: a change of 1 is twice the grip, and is shown as a ratio. A draw that no grip held
counts as one step above the largest, one that the least held as the least, so that effects err
towards none there. */
/** A finished trial of a sweep and the grip thresholds of its draw under its condition. */
struct SweepTrial {
  const TrialRecord* record = nullptr;
  /** On each of kThresholdScales; infinite: no grip held; NaN: it was not looked for. */
  std::array<double, std::size(kThresholdScales)> thresholds = {kUnset, kUnset};
};

struct SweepMeasure {
  const char* id;     ///< "success"
  const char* label;  ///< "success [%]", which is
  double scale;       ///< times the value, with
  int decimals;
  double (*value)(const SweepTrial& trial);   ///< NaN: it has none
  const ThresholdScale* threshold = nullptr;  ///< of grip thresholds: their scale

  /** What effects are sums of. */
  double CalcEffectValue(const SweepTrial& trial) const;
};
/** Success, GFT%, sigma, breaking force (judged trials; an empty hand's is none), grip thresholds.
*/
const std::vector<SweepMeasure>& ListSweepMeasures();
/** @pre there is one with this id */
const SweepMeasure& FindSweepMeasure(const std::string& id);

/** A value: "12.5", "n/a", "none held". */
std::string FormatValue(const SweepMeasure& measure, double value);
/** What a level changes: "-0.50", of a threshold "x 1.41". */
std::string FormatChange(const SweepMeasure& measure, double change);
std::string FormatChangeInterval(const SweepMeasure& measure, const Interval& interval);

/** One condition and one hand. */
struct ConditionRow {
  std::string name;  ///< empty: the base
  std::vector<std::string> levels;
  std::string hand;
  int num_planned = 0, num_finished = 0, num_successes = 0, num_numerical = 0;
  /** Of ListSweepMeasures(); of success the rate; infinite: half of the draws never held. */
  std::vector<double> medians;
  /** Why these trials cannot decide what success depends on; empty: some succeed, some fail. */
  std::string undecided;
  /** Objects whose grasp is not the base's: "cup g3 to g4". */
  std::string other_grasps;
};

/** What one level, or two levels together, change. */
struct SweepEffect {
  std::vector<std::string> factors, levels;  ///< one or two: an interaction
  std::string measure, hand;
  ChangeEstimate change;
  int num_other_grasp = 0;   ///< of its draws: compared trials have other grasps
  int num_left_out = 0;      ///< of the planned draws
  std::string why_left_out;  ///< "2 not finished, 1 without a value"; empty: none is
  bool is_marginal = false;  ///< no two conditions differ in the factor alone

  bool excludes_zero() const {
    return change.interval && (change.interval->low > 0.0 || change.interval->high < 0.0);
  }
};

/** The thresholds of one condition and one hand. */
struct ConditionThresholds {
  const ThresholdScale* scale = nullptr;
  std::string name, hand;  ///< empty name: the base
  int num_draws = 0, num_below = 0, num_never = 0;
  std::string not_monotone;  ///< draws that fail again with a larger grip: "can 3, 5; cup 0"
};

struct SweepSummary {
  std::vector<SweepFactor> factors;
  std::vector<std::string> hands;
  std::vector<ConditionRow> rows;  ///< conditions, then hands
  std::vector<SweepEffect> effects, interactions;
  std::vector<ConditionThresholds> thresholds;  ///< scales, then conditions, then hands

  /** Interactions whose interval excludes 0. */
  std::vector<SweepEffect> FindInteractions() const;
  /** Whether a column is worth showing: thresholds are where they were looked for. */
  bool Shows(size_t measure) const;
};
/** @param thresholds  LoadThresholds(session). */
SweepSummary SummariseSweep(const Session& session,
                            const std::vector<ThresholdSummary>& thresholds);

/** "model.mass_scale=0.5 and grasp=g2". */
std::string NameEffect(const SweepEffect& effect);

/** As people see them. */
ShownTable ShowConditions(const SweepSummary& summary);
ShownTable ShowEffects(const std::vector<SweepEffect>& effects);
ShownTable ShowThresholds(const SweepSummary& summary);

/** conditions.csv and effects.csv with their dictionaries. */
std::vector<ExportTable> MakeSweepTables(const SweepSummary& summary);

Json ToJson(const SweepSummary& summary);

}  // namespace graspbench
