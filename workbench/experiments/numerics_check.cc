#include "workbench/experiments/numerics_check.h"

#include <algorithm>
#include <cmath>

#include "core/base/text/csv.h"
#include "core/base/units.h"

namespace graspbench {
namespace {

struct Measure {
  const char* name;  ///< column, with its unit
  double (*value)(const TrialResult&);
};
constexpr Measure kGct = {"gct_s", [](const TrialResult& r) { return r.timing.gct; }};
constexpr Measure kGft = {"gft_s", [](const TrialResult& r) { return r.timing.gft; }};
constexpr Measure kGot = {"got_s", [](const TrialResult& r) { return r.timing.got; }};
constexpr Measure kSigma = {"sigma", [](const TrialResult& r) { return r.stability.sigma; }};

double CalcChange(const NumericsComparison& comparison, const Measure& measure) {
  return measure.value(comparison.after) - measure.value(comparison.before.result);
}

ChangeSummary SummariseChanges(const std::string& variant,
                               const std::vector<NumericsComparison>& comparisons,
                               const Measure& measure) {
  std::vector<double> changes;
  for (const NumericsComparison& comparison : comparisons) {
    const double change = std::abs(CalcChange(comparison, measure));
    if (comparison.variant == variant && std::isfinite(change)) changes.push_back(change);
  }
  ChangeSummary summary;
  summary.num = static_cast<int>(changes.size());
  if (changes.empty()) {
    summary.median = summary.max = kUnset;
    return summary;
  }
  std::sort(changes.begin(), changes.end());
  const size_t n = changes.size();
  summary.median = 0.5 * (changes[(n - 1) / 2] + changes[n / 2]);
  summary.max = changes.back();
  return summary;
}

Json MakeChangeJson(const ChangeSummary& change) {
  return {{"median", JsonNumber(change.median)},
          {"max", JsonNumber(change.max)},
          {"compared", change.num}};
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
  add("half step", 0.5, 1.0);
  add("double step", 2.0, 1.0);
  add("half stiffness", 1.0, 0.5);
  add("double stiffness", 1.0, 2.0);
  variants.push_back({"compliant", {"backend=compliant"}});
  return variants;
}

NumericsSummary SummariseNumerics(const std::string& variant,
                                  const std::vector<NumericsComparison>& comparisons) {
  NumericsSummary summary;
  summary.variant = variant;
  for (const NumericsComparison& comparison : comparisons) {
    if (comparison.variant != variant) continue;
    ++summary.num_trials;
    summary.num_successes_before += comparison.before.result.outcome == Outcome::kSuccess;
    summary.num_successes += comparison.after.outcome == Outcome::kSuccess;
    summary.num_flips += comparison.is_flipped();
    summary.num_numerical_failures += comparison.after.outcome == Outcome::kNumericalFailure;
  }
  summary.gct = SummariseChanges(variant, comparisons, kGct);
  summary.gft = SummariseChanges(variant, comparisons, kGft);
  summary.got = SummariseChanges(variant, comparisons, kGot);
  summary.sigma = SummariseChanges(variant, comparisons, kSigma);
  return summary;
}

PreparedSession PrepareNumerics(const ExperimentRequest& request) {
  const Session session = LoadSession(request.folder, request.on_damage, RecordParts::kBrief);
  return PrepareExperiment(session, "numerics", ListNumericsVariants(session.config), request);
}

NumericsCheck CompareNumerics(const Session& experiment) {
  NumericsCheck check;
  for (const Condition& variant : experiment.config.conditions) {
    for (const ConditionPair& pair : ListConditionPairs(experiment, variant.name)) {
      check.comparisons.push_back({variant.name, *pair.base, pair.varied->result});
    }
    check.summaries.push_back(SummariseNumerics(variant.name, check.comparisons));
  }
  return check;
}

std::string FormatNumericsCsv(const std::vector<NumericsComparison>& comparisons) {
  std::vector<Json> heading = {"variant", "trial_id",       "hand",    "object", "grasp",
                               "trial",   "outcome_before", "outcome", "flipped"};
  for (const Measure& measure : {kGct, kGft, kGot, kSigma}) {
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
                               NameOf(comparison.after.outcome),
                               comparison.is_flipped() ? 1 : 0};
    for (const Measure& measure : {kGct, kGft, kGot, kSigma}) {
      cells.push_back(JsonNumber(measure.value(comparison.before.result)));
      cells.push_back(JsonNumber(measure.value(comparison.after)));
    }
    cells.push_back(JsonNumber(comparison.after.hold_creep));
    cells.push_back(JsonNumber(comparison.after.steady_penetration));
    cells.push_back(comparison.after.num_unconverged);
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
                        {"successes_before", summary.num_successes_before},
                        {"successes", summary.num_successes},
                        {"flips", summary.num_flips},
                        {"numerical_failures", summary.num_numerical_failures},
                        {"gct_change_s", MakeChangeJson(summary.gct)},
                        {"gft_change_s", MakeChangeJson(summary.gft)},
                        {"got_change_s", MakeChangeJson(summary.got)},
                        {"sigma_change", MakeChangeJson(summary.sigma)}});
  }
  for (const NumericsComparison& comparison : comparisons) {
    if (!comparison.is_flipped()) continue;
    Json flip = ToJson(comparison.before.plan);
    flip["variant"] = comparison.variant;
    flip["outcome_before"] = NameOf(comparison.before.result.outcome);
    flip["outcome"] = NameOf(comparison.after.outcome);
    flip["reason_before"] = comparison.before.result.reason;
    flip["reason"] = comparison.after.reason;
    flips.push_back(flip);
  }
  return {{"variants", variants}, {"flips", flips}};
}

}  // namespace graspbench
