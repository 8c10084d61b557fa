#include "datasets/analysis/map/map_trials.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "datasets/analysis/conditions/sweep_measures.h"
#include "datasets/plan/conditions.h"
#include "datasets/plan/map_design.h"
#include "datasets/session/find_trial.h"

namespace graspbench {
namespace {

/** What a condition says of its trials. */
struct Region {
  std::vector<size_t> levels;
  SessionConfig config;
  LateDigit late = LateDigit::kNone;
  double delay = 0.0;
};

/** By the condition's name; empty: the base. */
std::map<std::string, Region> ListRegions(const SessionConfig& config) {
  std::map<std::string, Region> regions;
  std::vector<Condition> conditions = config.conditions;
  conditions.push_back({});
  const auto levels = ListMapLevels(conditions, config);
  for (size_t i = 0; i < conditions.size(); ++i) {
    const ConditionInputs made = ApplyCondition(conditions[i], config);
    regions[conditions[i].name] = {levels[i], made.config, made.late, made.delay};
  }
  return regions;
}

/** GFT; infinite where a digit never touched, NaN where contacts came before closure. */
double FindFirstToLast(const TrialResult& result) {
  double first = INFINITY, last = -INFINITY;
  for (const DigitContact& contact : result.contacts) {
    if (std::isnan(contact.time)) return INFINITY;
    first = std::min(first, contact.time);
    last = std::max(last, contact.time);
  }
  return result.contacts.empty() || result.timing.contact_before_start ? kUnset : last - first;
}

double FindPush(const TrialResult& result) {
  if (std::isinf(FindFirstToLast(result))) return INFINITY;
  return result.closing ? result.closing->shift : kUnset;
}

}  // namespace

MapData ListMapTrials(const Session& session, const std::vector<ThresholdSummary>& thresholds) {
  MapData data;
  for (const MapFactorRow& row : ListMapFactors()) {
    MapFactor factor = {row.name, {}, row.scales_draws};
    for (const MapLevelRow& level : row.levels) factor.levels.push_back(level.name);
    data.factors.push_back(factor);
  }
  std::vector<double> margins(session.records.size(), kUnset);
  for (const ThresholdSummary& summary : thresholds) {
    if (summary.scale == &kThresholdScales[0]) margins = ListThresholdsOf(session, summary);
  }
  const SweepMeasure& threshold = FindSweepMeasure("threshold_margin");
  const bool is_judged = std::any_of(session.records.begin(), session.records.end(),
                                     [](const TrialRecord& record) { return record.judgement; });
  const std::map<std::string, Region> regions = ListRegions(session.config);
  for (size_t i = 0; i < session.records.size(); ++i) {
    const TrialRecord& record = session.records[i];
    if (IsNumericalFailure(record.result.outcome)) continue;
    const Region& region = regions.at(record.plan.condition.value_or(""));
    const TrialDraw draw = MakeObjectDraw(region.config, record.plan.object, record.plan.trial);
    MapTrial trial;
    trial.hand = record.plan.hand;
    trial.object = record.plan.object;
    trial.draw = record.plan.trial;
    trial.levels = region.levels;
    trial.late = region.late;
    trial.delay = region.delay;
    SweepTrial measured;
    measured.record = &record;
    measured.thresholds[0] = margins[i];
    const double strength = record.judgement ? record.judgement->breaking_force : kUnset;
    const bool is_success = IsSuccess(record.result.outcome);
    trial.values = {is_success ? 1.0 : 0.0, threshold.CalcEffectValue(measured),
                    FindPush(record.result), is_judged && !is_success ? 0.0 : strength};
    trial.first_to_last = FindFirstToLast(record.result);
    trial.offset = std::hypot(draw.offset_x, draw.offset_y);
    trial.turn = std::abs(draw.offset_yaw);
    trial.name = NameTrial(record.plan);
    data.trials.push_back(std::move(trial));
  }
  return data;
}

}  // namespace graspbench
