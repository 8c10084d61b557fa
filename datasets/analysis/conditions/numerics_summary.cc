#include "datasets/analysis/conditions/numerics_summary.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "core/base/text/csv.h"
#include "core/base/units.h"
#include "core/statistics/summary.h"
#include "datasets/session/session_experiments.h"

namespace graspbench {
std::vector<Condition> ListNumericsVariants(const SessionConfig& config) {
  std::vector<Condition> variants;
  const auto add = [&](const char* name, double step_factor, double stiffness_factor) {
    Condition variant = {name, {}};
    const auto set = [&](const char* key, double value, double factor) {
      if (factor != 1.0) variant.settings.push_back(key + ("=" + FormatJson(factor * value)));
    };
    set("sim.step_s", config.sim.step, step_factor);
    set("sim.contact_stiffness_n_per_m", config.sim.contact_stiffness, stiffness_factor);
    set("sim.tangential_stiffness_n_per_m", config.sim.tangential_stiffness, stiffness_factor);
    SessionConfig changed = config;
    for (const std::string& setting : variant.settings) ApplySetting(setting, changed);
    if (Validate(changed).empty()) variants.push_back(variant);
  };
  add("quarter step", 0.25, 1.0);
  add("half step", 0.5, 1.0);
  add("double step", 2.0, 1.0);
  add("half stiffness", 1.0, 0.5);
  add("double stiffness", 1.0, 2.0);
  for (const auto& [name, factor] :
       {std::pair("friction -0.1 %", 0.999), {"friction +0.1 %", 1.001}}) {
    variants.push_back(
        {name, {"model.friction_scale=" + FormatJson(factor * config.model.friction_scale)}});
  }
  variants.push_back({"compliant", {"backend=compliant"}});
  return variants;
}

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

namespace {

Json MakeChangeJson(const ChangeSummary& change) {
  return {{"median", JsonNumber(change.median)},
          {"max", JsonNumber(change.max)},
          {"compared", change.num}};
}

Json MakeSeatsJson(const NumericsSummary& summary) {
  Json seats = Json::array();
  for (const SeatNumerics& seat : summary.seats) {
    Json changes = Json::object();
    for (size_t i = 0; i < seat.changes.size(); ++i) {
      changes[ListNumericsMeasures()[i].name] = MakeChangeJson(seat.changes[i]);
    }
    seats.push_back({{"seat", seat.seat == Seat::kUnknown ? Json() : Json(NameOf(seat.seat))},
                     {"held", seat.num_held},
                     {"relative_changes", changes}});
  }
  return seats;
}

}  // namespace

std::string FormatNumericsCsv(const std::vector<NumericsComparison>& comparisons) {
  std::vector<Json> heading = {"variant", "trial_id",    "hand",           "object",
                               "grasp",   "trial",       "outcome_before", "outcome",
                               "flipped", "seat_before", "seat",           "flagged"};
  for (const NumericsMeasure& measure : ListNumericsMeasures()) {
    heading.push_back(std::string(measure.name) + "_before");
    heading.push_back(measure.name);
  }
  for (const char* name : {"hold_creep_m", "steady_penetration_m", "unconverged_steps"}) {
    heading.push_back(name);
  }
  std::string csv = FormatCsvLine(heading);
  for (const NumericsComparison& comparison : comparisons) {
    const PlannedTrial& plan = comparison.before.plan;
    std::vector<Json> cells = {comparison.variant,
                               plan.id,
                               plan.hand,
                               plan.object,
                               plan.grasp,
                               plan.trial,
                               NameOf(comparison.before.result.outcome),
                               NameOf(comparison.after.result.outcome),
                               comparison.is_flipped() ? 1 : 0,
                               NameOf(FindSeat(comparison.before.result)),
                               NameOf(FindSeat(comparison.after.result)),
                               comparison.is_flagged() ? 1 : 0};
    for (const NumericsMeasure& measure : ListNumericsMeasures()) {
      cells.push_back(JsonNumber(measure.value(comparison.before)));
      cells.push_back(JsonNumber(measure.value(comparison.after)));
    }
    cells.push_back(JsonNumber(comparison.after.result.hold_creep));
    cells.push_back(JsonNumber(comparison.after.result.steady_penetration));
    cells.push_back(comparison.after.result.num_unconverged);
    csv += FormatCsvLine(cells);
  }
  return csv;
}

Json MakeNumericsJson(const std::vector<NumericsSummary>& summaries,
                      const std::vector<NumericsComparison>& comparisons) {
  Json variants = Json::array(), flips = Json::array();
  for (const NumericsSummary& summary : summaries) {
    variants.push_back({{"variant", summary.variant},
                        {"trials", summary.num_trials},
                        {"left_out", summary.num_left_out},
                        {"successes_before", summary.num_successes_before},
                        {"successes", summary.num_successes},
                        {"flips", summary.num_flips},
                        {"numerical_failures", summary.num_numerical_failures},
                        {"held", summary.num_held},
                        {"seat_flips", summary.num_seat_flips},
                        {"flagged", summary.num_flagged},
                        {"large_changes_unflagged", summary.num_large},
                        {"seats", MakeSeatsJson(summary)}});
  }
  for (const NumericsComparison& comparison : comparisons) {
    if (!comparison.is_flipped()) continue;
    Json flip = ToJson(comparison.before.plan);
    flip["variant"] = comparison.variant;
    flip["outcome_before"] = NameOf(comparison.before.result.outcome);
    flip["outcome"] = NameOf(comparison.after.result.outcome);
    flip["reason_before"] = comparison.before.result.reason;
    flip["reason"] = comparison.after.result.reason;
    flips.push_back(flip);
  }
  return {{"variants", variants}, {"flips", flips}};
}

}  // namespace graspbench
