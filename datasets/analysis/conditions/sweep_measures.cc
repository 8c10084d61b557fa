#include "datasets/analysis/conditions/sweep_measures.h"

#include <algorithm>
#include <cmath>

#include "core/base/error.h"
#include "core/base/text/range_text.h"
#include "core/base/text/text.h"

namespace graspbench {
namespace {

double FindBreakingForce(const SweepTrial& trial) {
  return trial.record->judgement ? trial.record->judgement->breaking_force : kUnset;
}

}  // namespace

double SweepMeasure::CalcEffectValue(const SweepTrial& trial) const {
  const double found = value(trial);
  if (!threshold || std::isnan(found)) return found;
  const double step = std::log2(threshold->most / threshold->least) / kMostGripPlace;
  return std::isinf(found) ? std::log2(threshold->most) + step : std::log2(found);
}

const std::vector<SweepMeasure>& ListSweepMeasures() {
  static const std::vector<SweepMeasure> measures = {
      {"success", "success [%]", 100.0, 1,
       [](const SweepTrial& trial) { return IsSuccess(trial.record->result.outcome) ? 1.0 : 0.0; }},
      {"gft_ratio", "GFT% [%]", 100.0, 1,
       [](const SweepTrial& trial) {
         const TrialResult& result = trial.record->result;
         const bool has_times =
             !IsNumericalFailure(result.outcome) && !result.timing.contact_before_start;
         return has_times ? result.timing.gft_ratio : kUnset;
       }},
      {"sigma_n", "sigma [N]", 1.0, 2,
       [](const SweepTrial& trial) { return trial.record->result.stability.sigma; }},
      {"breaking_force_n", "breaking force [N]", 1.0, 2, &FindBreakingForce},
      {"threshold_margin", "grip threshold, margin", 1.0, 2,
       [](const SweepTrial& trial) { return trial.thresholds[0]; }, &kThresholdScales[0]},
      {"threshold_force_n", "grip threshold, force [N]", 1.0, 2,
       [](const SweepTrial& trial) { return trial.thresholds[1]; }, &kThresholdScales[1]}};
  return measures;
}

const SweepMeasure& FindSweepMeasure(const std::string& id) {
  const auto& measures = ListSweepMeasures();
  const auto found = std::find_if(measures.begin(), measures.end(),
                                  [&](const SweepMeasure& measure) { return measure.id == id; });
  GRASPBENCH_DEMAND(found != measures.end(), id);
  return *found;
}

std::string FormatValue(const SweepMeasure& measure, double value) {
  if (std::isinf(value)) return "none held";
  return std::isnan(value) ? "n/a" : FormatFixed(measure.scale * value, measure.decimals);
}

std::string FormatChange(const SweepMeasure& measure, double change) {
  if (measure.threshold) return "x " + FormatFixed(std::exp2(change), measure.decimals);
  return FormatFixed(measure.scale * change, measure.decimals);
}

std::string FormatChangeInterval(const SweepMeasure& measure, const Interval& interval) {
  if (!measure.threshold) {
    return FormatRange(measure.scale * interval.low, measure.scale * interval.high,
                       measure.decimals);
  }
  return "x " + FormatRange(std::exp2(interval.low), std::exp2(interval.high), measure.decimals);
}

}  // namespace graspbench
