#include "workbench/experiments/numerics_check.h"

#include "core/base/text/csv.h"
#include "core/base/units.h"

namespace graspbench {
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

PreparedSession PrepareNumerics(const ExperimentRequest& request) {
  const Session session = LoadSession(request.folder, request.on_damage, RecordParts::kBrief);
  return PrepareExperiment(session, "numerics", ListNumericsVariants(session.config), request);
}

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
