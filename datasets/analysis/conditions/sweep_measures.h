#pragma once
/** @file
What a sweep compares (sweep_summary.h) of its trials.

A grip threshold (threshold_summary.h) enters effects as its binary logarithm, because its scale has
equal ratios: a change of 1 is twice the grip, and is shown as a ratio. A draw that no grip held
counts as one step above the largest, one that the least held as the least, so that effects err
towards none there. */

#include <array>
#include <string>
#include <vector>

#include "core/statistics/proportion.h"
#include "datasets/analysis/conditions/threshold_summary.h"

namespace graspbench {

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

}  // namespace graspbench
