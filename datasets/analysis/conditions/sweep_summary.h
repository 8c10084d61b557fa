#pragma once
/** @file
Effects of the factors of a sweep (datasets/plan/conditions.h), on the same draws.

A draw is one hand, object and number; y(c) is a measure of its trial under condition c. The effect
of level l of factor A on a draw is the mean of

    y(c') - y(c)    over all pairs of conditions that differ in A alone, l in c' and the base in c,

If a design has no such pair (Latin hypercubes), it is the mean over all c' with l minus that over
all c with the base's level. The interaction of levels l and m of A and B is the mean of

    y(l, m) - y(l, 0) - y(0, m) + y(0, 0)    over all such sets of four conditions.

Estimates are means over the draws that have every value; the number of planned draws left out is
reported with the reason. Draws, estimates and intervals are those of datasets/analysis/pairs.h. Of
the many intervals one in twenty excludes 0 by chance. For a grip threshold y is its binary
logarithm. */

#include <array>
#include <string>
#include <vector>

#include "datasets/analysis/conditions/threshold_summary.h"
#include "datasets/analysis/pairs.h"
#include "datasets/plan/conditions.h"
#include "datasets/session/session_store.h"

namespace graspbench {

/* Measures that a sweep compares.

A grip threshold (threshold_summary.h) enters effects as its binary logarithm, because its scale has
equal ratios: a change of 1 is twice the grip, and is displayed as a ratio. A draw that no grip held
counts as one step above the largest grip, one that the least grip held as the least, so that
effects are biased towards zero there. */
/** A finished trial of a sweep with the grip thresholds of its draw under its condition. */
struct SweepTrial {
  const TrialRecord* record = nullptr;
  /** On each of kThresholdScales; infinite: no grip held; NaN: not searched. */
  std::array<double, std::size(kThresholdScales)> thresholds = {kUnset, kUnset};
};

struct SweepMeasure {
  const char* id;     ///< "success"
  const char* label;  ///< "success [%]"
  double scale;       ///< displayed number = scale * value
  int decimals;
  double (*value)(const SweepTrial& trial);   ///< NaN: none
  const ThresholdScale* threshold = nullptr;  ///< scale of a grip threshold, else null

  /** Returns the value that enters effects. */
  double CalcEffectValue(const SweepTrial& trial) const;
};
/** Success, GFT%, sigma, breaking force (judged trials; 0 N for an empty hand) and grip
thresholds. */
const std::vector<SweepMeasure>& ListSweepMeasures();
/** @pre there is a measure with this id. */
const SweepMeasure& FindSweepMeasure(const std::string& id);

/** Formats a value: "12.5", "n/a", "none held". */
std::string FormatValue(const SweepMeasure& measure, double value);
/** Formats a change: "-0.50", or "x 1.41" for a threshold. */
std::string FormatChange(const SweepMeasure& measure, double change);
std::string FormatChangeInterval(const SweepMeasure& measure, const Interval& interval);

/** One condition and one hand. */
struct ConditionRow {
  std::string name;  ///< empty: the base
  std::vector<std::string> levels;
  std::string hand;
  int num_planned = 0, num_finished = 0, num_successes = 0, num_numerical = 0;
  /** Medians of ListSweepMeasures(), the rate for success; infinite: half of the draws never
  held. */
  std::vector<double> medians;
  /** Why these trials cannot show an effect on success; empty: some succeed, some fail. */
  std::string undecided;
  /** Objects whose grasp differs from the base's: "cup g3 to g4". */
  std::string other_grasps;
};

/** The effect of one level, or the interaction of two. */
struct SweepEffect {
  std::vector<std::string> factors, levels;  ///< one or two: an interaction
  std::string measure, hand;
  ChangeEstimate change;
  int num_other_grasp = 0;   ///< draws whose compared trials have different grasps
  int num_left_out = 0;      ///< planned draws left out
  std::string why_left_out;  ///< "2 not finished, 1 without a value"; empty: none
  bool is_marginal = false;  ///< true if no two conditions differ in the factor alone

  bool excludes_zero() const {
    return change.interval && (change.interval->low > 0.0 || change.interval->high < 0.0);
  }
};

/** The thresholds of one condition and one hand. */
struct ConditionThresholds {
  const ThresholdScale* scale = nullptr;
  std::string name, hand;  ///< empty name: the base
  int num_draws = 0, num_below = 0, num_never = 0;
  std::string not_monotone;  ///< draws that fail with a larger grip: "can 3, 5; cup 0"
};

struct SweepSummary {
  std::vector<SweepFactor> factors;
  std::vector<std::string> hands;
  std::vector<ConditionRow> rows;  ///< conditions, then hands
  std::vector<SweepEffect> effects, interactions;
  std::vector<ConditionThresholds> thresholds;  ///< scales, then conditions, then hands

  /** Interactions whose interval excludes 0. */
  std::vector<SweepEffect> FindInteractions() const;
  /** Whether to display a measure; thresholds only if they were searched. */
  bool Shows(size_t measure) const;
};
/** @param thresholds  LoadThresholds(session). */
SweepSummary SummariseSweep(const Session& session,
                            const std::vector<ThresholdSummary>& thresholds);

/** Returns "model.mass_scale=0.5 and grasp=g2". */
std::string NameEffect(const SweepEffect& effect);

/** Make the displayed tables. */
ShownTable ShowConditions(const SweepSummary& summary);
ShownTable ShowEffects(const std::vector<SweepEffect>& effects);
ShownTable ShowThresholds(const SweepSummary& summary);

/** Makes conditions.csv and effects.csv with their dictionaries. */
std::vector<ExportTable> MakeSweepTables(const SweepSummary& summary);

Json ToJson(const SweepSummary& summary);

}  // namespace graspbench
