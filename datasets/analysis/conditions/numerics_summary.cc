#include "datasets/analysis/conditions/numerics_summary.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "core/base/units.h"
#include "core/statistics/summary.h"
#include "datasets/session/session_experiments.h"

namespace graspbench {
namespace {

double TakeGrip(const TrialRecord& record) { return record.result.stability.hold.normal_force; }
double TakeSigma(const TrialRecord& record) { return record.result.stability.sigma; }
double TakeBreakingForce(const TrialRecord& record) {
  return record.judgement ? record.judgement->breaking_force : kUnset;
}

/** Not finite where one of them has none. */
double CalcChange(const NumericsComparison& comparison, double (*value)(const TrialRecord&)) {
  const double before = value(comparison.before);
  return std::abs(value(comparison.after) - before) / std::abs(before);
}

ChangeSummary SummariseChanges(const std::vector<const NumericsComparison*>& comparisons,
                               double (*value)(const TrialRecord&)) {
  std::vector<double> changes;
  for (const NumericsComparison* comparison : comparisons) {
    const double change = CalcChange(*comparison, value);
    if (std::isfinite(change)) changes.push_back(change);
  }
  if (changes.empty()) return {kUnset, kUnset, 0};
  return {CalcMedian(changes), *std::max_element(changes.begin(), changes.end()),
          static_cast<int>(changes.size())};
}

void Add(const NumericsComparison& comparison, NumericsSummary& summary) {
  ++summary.num_trials;
  summary.num_successes_before += IsSuccess(comparison.before.result.outcome);
  summary.num_successes += IsSuccess(comparison.after.result.outcome);
  summary.num_flips += comparison.is_flipped();
  summary.num_numerical_failures += IsNumericalFailure(comparison.after.result.outcome);
  if (!comparison.is_held()) return;
  ++summary.num_held;
  summary.num_seat_flips += comparison.is_seat_flipped();
  summary.num_flagged += comparison.is_flagged();
  summary.num_large += !comparison.is_flagged() && comparison.has_large_change();
}

}  // namespace

bool NumericsComparison::is_flipped() const {
  return IsSuccess(before.result.outcome) != IsSuccess(after.result.outcome);
}

bool NumericsComparison::is_held() const {
  return IsSuccess(before.result.outcome) && IsSuccess(after.result.outcome);
}

bool NumericsComparison::is_seat_flipped() const {
  return is_held() && FindSeat(before.result) != FindSeat(after.result);
}

bool NumericsComparison::is_flagged() const {
  return FindSeat(before.result) == Seat::kReseated || IsCaged(before.result);
}

bool NumericsComparison::has_large_change() const {
  const auto is_large = [this](double (*value)(const TrialRecord&)) {
    return CalcChange(*this, value) > kLargeChange;
  };
  return is_large(TakeGrip) || is_large(TakeSigma) || is_large(TakeBreakingForce);
}

const std::vector<NumericsMeasure>& ListNumericsMeasures() {
  static const std::vector<NumericsMeasure> measures = {
      {"gct_s", "GCT", [](const TrialRecord& r) { return r.result.timing.gct; }},
      {"gft_s", "GFT", [](const TrialRecord& r) { return r.result.timing.gft; }},
      {"got_s", "GOT", [](const TrialRecord& r) { return r.result.timing.got; }},
      {"sigma", "sigma", TakeSigma},
      {"grip_n", "grip", TakeGrip},
      {"breaking_force_n", "breaking force", TakeBreakingForce}};
  return measures;
}

std::vector<NumericsSummary> SummariseNumerics(const std::vector<NumericsComparison>& comparisons) {
  std::vector<NumericsSummary> summaries;
  std::map<std::string, size_t> places;
  std::vector<std::map<Seat, std::vector<const NumericsComparison*>>> held;
  std::set<std::string> bases;
  for (const NumericsComparison& comparison : comparisons) {
    const auto [place, is_new] = places.emplace(comparison.variant, summaries.size());
    if (is_new) {
      summaries.emplace_back();
      summaries.back().variant = comparison.variant;
      held.emplace_back();
    }
    Add(comparison, summaries[place->second]);
    bases.insert(comparison.before.plan.id);
    if (!comparison.is_held() || comparison.is_seat_flipped()) continue;
    held[place->second][FindSeat(comparison.before.result)].push_back(&comparison);
  }
  for (size_t i = 0; i < summaries.size(); ++i) {
    summaries[i].num_left_out = static_cast<int>(bases.size()) - summaries[i].num_trials;
    for (const Seat seat : kSeats) {
      if (held[i][seat].empty()) continue;
      SeatNumerics& one = summaries[i].seats.emplace_back();
      one.seat = seat;
      one.num_held = static_cast<int>(held[i][seat].size());
      for (const NumericsMeasure& measure : ListNumericsMeasures()) {
        one.changes.push_back(SummariseChanges(held[i][seat], measure.value));
      }
    }
  }
  return summaries;
}

std::vector<NumericsComparison> ListNumericsComparisons(const Session& experiment) {
  std::map<std::string, const TrialRecord*> bases;
  for (const TrialRecord& record : experiment.records) {
    if (!record.plan.condition) bases.emplace(NameDraw(record.plan), &record);
  }
  std::vector<NumericsComparison> comparisons;
  for (const Condition& variant : experiment.config.conditions) {
    for (const TrialRecord& record : experiment.records) {
      const auto base = bases.find(NameDraw(record.plan));
      if (record.plan.condition != variant.name || base == bases.end()) continue;
      comparisons.push_back({variant.name, *base->second, record});
    }
  }
  return comparisons;
}

std::vector<NumericsComparison> LoadNumericsComparisons(const Session& session) {
  std::vector<NumericsComparison> comparisons;
  std::set<std::string> known;  // an experiment of more trials repeats those of a smaller one
  for (const Session& experiment : LoadExperiments(session, "numerics")) {
    for (NumericsComparison& comparison : ListNumericsComparisons(experiment)) {
      if (!known.insert(comparison.after.plan.id).second) continue;
      comparisons.push_back(std::move(comparison));
    }
  }
  return comparisons;
}

}  // namespace graspbench
