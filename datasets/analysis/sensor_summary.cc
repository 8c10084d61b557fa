#include "datasets/analysis/sensor_summary.h"

#include <algorithm>
#include <cmath>

#include "core/statistics/summary.h"
#include "datasets/plan/session_plan.h"

namespace graspbench {
namespace {

struct PlaceSamples {
  PlaceErrors errors;
  std::vector<double> shifts, turns;
};

PlaceSamples& FindPlace(std::vector<PlaceSamples>& places, const PlannedTrial& plan) {
  for (PlaceSamples& place : places) {
    if (place.errors.hand == plan.hand && place.errors.object == plan.object) return place;
  }
  places.emplace_back();
  places.back().errors.hand = plan.hand;
  places.back().errors.object = plan.object;
  return places.back();
}

void AddPlace(const TrialRecord& record, const TrialDraw& draw, std::vector<PlaceSamples>& places) {
  PlaceSamples& place = FindPlace(places, record.plan);
  ++place.errors.num_trials;
  const TrialResult& result = record.result;
  if (std::isnan(result.believed_x)) return;
  ++place.errors.num_found;
  place.shifts.push_back(
      std::hypot(result.believed_x - draw.offset_x, result.believed_y - draw.offset_y));
  place.turns.push_back(std::abs(std::remainder(result.believed_yaw - draw.offset_yaw, kPi)));
}

PlaceErrors Summarise(const PlaceSamples& place) {
  PlaceErrors errors = place.errors;
  if (place.shifts.empty()) return errors;
  errors.median = CalcMedian(place.shifts);
  errors.worst = *std::max_element(place.shifts.begin(), place.shifts.end());
  errors.median_turn = CalcMedian(place.turns);
  errors.worst_turn = *std::max_element(place.turns.begin(), place.turns.end());
  return errors;
}

void AddTouches(const TrialRecord& record, std::vector<FeltTouches>& touches) {
  if (!record.result.touch) return;
  const TouchRecord& touch = *record.result.touch;
  auto felt = std::find_if(touches.begin(), touches.end(),
                           [&](const FeltTouches& t) { return t.hand == record.plan.hand; });
  if (felt == touches.end()) {
    FeltTouches none;
    none.hand = record.plan.hand;
    none.sum.peak.assign(touch.peak.size(), 0.0);
    felt = touches.insert(touches.end(), none);
  }
  ++felt->num_trials;
  TouchRecord& sum = felt->sum;
  sum.num_touches += touch.num_touches;
  sum.num_felt_in_time += touch.num_felt_in_time;
  sum.num_felt_late += touch.num_felt_late;
  sum.num_elsewhere += touch.num_elsewhere;
  sum.longest_delay = std::max(sum.longest_delay, touch.longest_delay);
  for (size_t i = 0; i < std::min(sum.peak.size(), touch.peak.size()); ++i) {
    sum.peak[i] = std::max(sum.peak[i], touch.peak[i]);
  }
}

}  // namespace

SensorSummary SummariseSensors(const Session& session) {
  SensorSummary summary;
  std::vector<PlaceSamples> places;
  ForEachWhole(session, [&](const TrialRecord& record) {
    const TrialDraw draw = MakeObjectDraw(session.config, record.plan.object, record.plan.trial);
    AddTouches(record, summary.touches);
    AddPlace(record, draw, places);
  });
  for (const PlaceSamples& place : places) summary.places.push_back(Summarise(place));
  return summary;
}

}  // namespace graspbench
