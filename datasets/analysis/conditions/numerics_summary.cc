#include "datasets/analysis/conditions/numerics_summary.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "core/base/file_keys.h"
#include "core/base/text/csv.h"
#include "core/base/text/text.h"
#include "core/base/units.h"
#include "core/statistics/summary.h"
#include "datasets/analysis/pairs.h"
#include "datasets/session/find_trial.h"

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
  if (!HasArm(config.arm)) variants.push_back({"compliant", {"backend=compliant"}});
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
      one.variant = summaries[i].variant;
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
  std::vector<NumericsComparison> comparisons;
  for (const Condition& variant : experiment.config.conditions) {
    for (const ComparedDraw& draw :
         ListComparedDraws({{&experiment}, {&experiment, variant.name}})) {
      if (!draw.records[0] || !draw.records[1]) continue;
      comparisons.push_back({variant.name, *draw.records[0], *draw.records[1]});
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

/** "0.4 (12)": median and largest [%]. */
std::string FormatChange(const ChangeSummary& change) {
  if (change.num == 0) return "n/a";
  return FormatSignificant(100.0 * change.median, 2) + " (" +
         FormatSignificant(100.0 * change.max, 2) + ")";
}

std::vector<CsvColumn<SeatNumerics>> ListSeatChangeColumns() {
  using Row = SeatNumerics;
  using C = CsvColumn<Row>;
  const auto name = [](const Row& row) {
    return row.seat == Seat::kUnknown ? Json() : Json(NameOf(row.seat));
  };
  std::vector<C> columns = {
      C::ForPeople("change [%] in", "", [](const Row& row) { return row.variant; }),
      C("seat", "string", "", "", name)
          .Shown(
              "seat",
              [](const Row& row) { return row.seat == Seat::kUnknown ? "n/a" : NameOf(row.seat); }),
      C("held", "", "", &Row::num_held).Shown("held"),
      {"relative_changes", "string", "", "", [](const Row& row) {
         Json changes = Json::object();
         for (size_t i = 0; i < row.changes.size(); ++i) {
           const ChangeSummary& change = row.changes[i];
           changes[ListNumericsMeasures()[i].name] = {{"median", JsonNumber(change.median)},
                                                      {"max", JsonNumber(change.max)},
                                                      {"compared", change.num}};
         }
         return changes;
       }}};
  for (size_t i = 0; i < ListNumericsMeasures().size(); ++i) {
    columns.push_back(C::ForPeople(ListNumericsMeasures()[i].title,
                                   "median (largest) relative change",
                                   [i](const Row& row) { return FormatChange(row.changes[i]); }));
  }
  return columns;
}

std::vector<CsvColumn<NumericsSummary>> ListNumericsVariantColumns() {
  using Row = NumericsSummary;
  using C = CsvColumn<Row>;
  return {
      C("variant", "", "", &Row::variant).Shown("variant"),
      C("trials", "", "n of N: the others are unfinished or unsupported", &Row::num_trials)
          .Shown("trials",
                 [](const Row& row) {
                   return FormatCountOf(row.num_trials, row.num_trials + row.num_left_out);
                 }),
      {"left_out", "", "", &Row::num_left_out},
      C("successes_before", "", "", &Row::num_successes_before).Shown("held before"),
      C("successes", "", "", &Row::num_successes).Shown("held now"),
      C("flips", "", "a success becomes a failure, or the reverse", &Row::num_flips).Shown("flips"),
      {"numerical_failures", "", "", &Row::num_numerical_failures},
      {"held", "", "", &Row::num_held},
      C("seat_flips", "", "held in both runs", &Row::num_seat_flips).Shown("seat flips"),
      C("flagged", "", "held trials that are reseated or caged in this session", &Row::num_flagged)
          .Shown("flagged"),
      C("large_changes_unflagged", "",
        "other held trials whose grip, sigma or breaking force changes by more", &Row::num_large)
          .Shown("others above 10 %"),
      {"seats", "string", "", "",
       [](const Row& row) { return MakeJsonRows(ListSeatChangeColumns(), row.seats); }}};
}

std::vector<CsvColumn<NumericsComparison>> ListNumericsComparisonColumns() {
  using Row = NumericsComparison;
  using C = CsvColumn<Row>;
  const auto plan = [](auto PlannedTrial::*member) {
    return [member](const Row& row) { return row.before.plan.*member; };
  };
  std::vector<C> columns = {
      C("variant", "", "the other numerics", &Row::variant).Shown("flips in"),
      {"trial_id", "", "of the session's trial", plan(&PlannedTrial::id)},
      C("hand", "", "id of the hand", plan(&PlannedTrial::hand)).Shown("hand"),
      C("object", "", "id of the object", plan(&PlannedTrial::object)).Shown("object"),
      C("grasp", "", "id of the grasp", plan(&PlannedTrial::grasp)).Shown("grasp"),
      C("trial", "", "number of the trial within its hand, object and grasp, from 0",
        plan(&PlannedTrial::trial))
          .Shown("trial"),
      C("outcome_before", "", "outcome of the session's trial",
        [](const Row& row) {
          return NameOf(row.before.result.outcome);
        }).Shown("before"),
      C("outcome", "", "outcome with the other numerics",
        [](const Row& row) {
          return NameOf(row.after.result.outcome);
        }).Shown("after"),
      {"flipped", "", "1 when only one of the two is a success", &Row::is_flipped},
      {"seat_before", "", "seat of the session's trial",
       [](const Row& row) { return NameOf(FindSeat(row.before.result)); }},
      {"seat", "", "with the other numerics",
       [](const Row& row) { return NameOf(FindSeat(row.after.result)); }},
      {"flagged", "", "1 when the check reports the trial", &Row::is_flagged}};
  for (const NumericsMeasure& measure : ListNumericsMeasures()) {
    columns.push_back({measure.name + std::string("_before"), FindUnit(measure.name),
                       std::string(measure.title) + " of the session's trial",
                       [&measure](const Row& row) { return measure.value(row.before); }});
    columns.push_back({measure.name, FindUnit(measure.name),
                       std::string(measure.title) + " with the other numerics",
                       [&measure](const Row& row) { return measure.value(row.after); }});
  }
  columns.push_back({"hold_creep_m", "m", "motion of the held object in the hand",
                     [](const Row& row) { return row.after.result.hold_creep; }});
  columns.push_back({"steady_penetration_m", "m", "deepest overlap at the end of the hold",
                     [](const Row& row) { return row.after.result.steady_penetration; }});
  columns.push_back({"unconverged_steps", "", "steps whose solve missed its tolerance",
                     [](const Row& row) { return row.after.result.num_unconverged; }});
  return columns;
}

std::vector<NumericsComparison> ListFlips(const std::vector<NumericsComparison>& comparisons) {
  std::vector<NumericsComparison> flips;
  std::copy_if(comparisons.begin(), comparisons.end(), std::back_inserter(flips),
               [](const NumericsComparison& comparison) { return comparison.is_flipped(); });
  return flips;
}

}  // namespace

std::string FormatNumericsCsv(const std::vector<NumericsComparison>& comparisons) {
  return FormatCsv(ListNumericsComparisonColumns(), comparisons);
}

Json MakeNumericsSchema() { return MakeTableSchema(ListNumericsComparisonColumns(), ""); }

ShownTable ShowVariants(const std::vector<NumericsSummary>& summaries) {
  return ShowTable(ListNumericsVariantColumns(), summaries);
}

ShownTable ShowSeatChanges(const std::vector<NumericsSummary>& summaries) {
  std::vector<SeatNumerics> seats;
  for (const NumericsSummary& summary : summaries) {
    seats.insert(seats.end(), summary.seats.begin(), summary.seats.end());
  }
  return ShowTable(ListSeatChangeColumns(), seats);
}

ShownTable ShowFlips(const std::vector<NumericsComparison>& comparisons) {
  return ShowTable(ListNumericsComparisonColumns(), ListFlips(comparisons));
}

Json MakeNumericsJson(const std::vector<NumericsSummary>& summaries,
                      const std::vector<NumericsComparison>& comparisons) {
  Json flips = Json::array();
  for (const NumericsComparison& comparison : ListFlips(comparisons)) {
    Json flip = ToJson(comparison.before.plan);
    flip["variant"] = comparison.variant;
    flip["outcome_before"] = NameOf(comparison.before.result.outcome);
    flip["outcome"] = NameOf(comparison.after.result.outcome);
    flip["reason_before"] = comparison.before.result.reason;
    flip["reason"] = comparison.after.result.reason;
    flips.push_back(flip);
  }
  return {{"variants", MakeJsonRows(ListNumericsVariantColumns(), summaries)}, {"flips", flips}};
}

}  // namespace graspbench
