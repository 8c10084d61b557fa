#include "workbench/experiments/numerics_check.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <memory>
#include <set>
#include <tuple>

#include "core/base/error.h"
#include "core/base/text/csv.h"
#include "core/base/units.h"
#include "core/physics/compliant_world.h"
#include "core/physics/sim_config.h"
#include "core/trial/compliant_trial.h"
#include "core/trial/trial_result.h"
#include "workbench/experiments/pool/batch_runner.h"
#include "workbench/experiments/pool/session_worker.h"

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

std::vector<NumericsVariant> ListNumericsVariants(const SimConfig& sim) {
  std::vector<NumericsVariant> variants;
  const auto add = [&](const char* id, double step_factor, double stiffness_factor) {
    SimConfig changed = sim;
    changed.step *= step_factor;
    changed.contact_stiffness *= stiffness_factor;
    changed.tangential_stiffness *= stiffness_factor;
    variants.push_back({id, changed, false});
  };
  add("half step", 0.5, 1.0);
  add("double step", 2.0, 1.0);
  add("half stiffness", 1.0, 0.5);
  add("double stiffness", 1.0, 2.0);
  variants.push_back({"compliant", sim, true});
  return variants;
}

std::vector<TrialRecord> ChooseTrials(const std::vector<TrialRecord>& records,
                                      int trials_per_cell) {
  std::map<std::tuple<std::string, std::string, std::string>, int> num_chosen;
  std::vector<TrialRecord> chosen;
  for (const TrialRecord& record : records) {
    const PlannedTrial& plan = record.plan;
    if (++num_chosen[{plan.hand, plan.object, plan.grasp}] <= trials_per_cell) {
      chosen.push_back(record);
    }
  }
  return chosen;
}

std::vector<TrialRecord> FindCovered(const std::vector<TrialRecord>& trials,
                                     const NumericsVariant& variant, const SessionInputs& inputs) {
  if (!variant.is_compliant) return trials;
  std::set<std::string> hands, objects;
  for (const SessionHand& hand : inputs.hands) {
    if (CanMoveCompliantly(*hand.hand)) hands.insert(hand.hand->id);
  }
  for (const auto& object : inputs.objects) {
    if (CanMoveCompliantly(*object)) objects.insert(object->id);
  }
  std::vector<TrialRecord> covered;
  for (const TrialRecord& trial : trials) {
    if (hands.count(trial.plan.hand) && objects.count(trial.plan.object)) covered.push_back(trial);
  }
  return covered;
}

std::vector<TrialResult> RerunTrials(const std::vector<TrialRecord>& trials,
                                     const NumericsVariant& variant, const SessionConfig& config,
                                     const SessionInputs& inputs, int num_workers,
                                     Observer& observer, const std::atomic<bool>& stop) {
  SessionConfig changed = config;
  changed.sim = variant.sim;
  std::vector<PlannedTrial> plan;
  std::map<std::string, size_t> position;
  for (const TrialRecord& trial : trials) {
    position[trial.plan.id] = plan.size();
    plan.push_back(trial.plan);
  }
  // Each trial writes to its own place, so the workers need no lock.
  std::vector<TrialResult> results(plan.size());
  const MakeBatchWorker make_worker = [&](int) {
    const auto runner = std::make_shared<PlannedTrialRunner>(changed, inputs);
    return BatchWorker{[&, runner](const PlannedTrial& planned) {
                         return variant.is_compliant
                                    ? RunCompliantTrial(MakeTrialSetup(changed, inputs, planned))
                                    : runner->Run(planned);
                       },
                       [&results, &position](const TrialRecord& record) {
                         results[position.at(record.plan.id)] = record.result;
                       },
                       {},
                       [runner](const PlannedTrial& planned) { runner->Prepare(planned); }};
  };
  Stage stage;
  stage.kind = StageKind::kVariant;
  stage.variant = variant.id;
  stage.num_all = stage.num_left = stage.num_trials = static_cast<int>(plan.size());
  if (!RunBatchStage(stage, plan, num_workers, make_worker, observer, stop, kTrialTimeLimit)) {
    throw Error(ErrorKind::kInterrupted, "stopped; nothing was written");
  }
  return results;
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

NumericsCheck CheckNumerics(const std::filesystem::path& folder, const Session& session,
                            int trials_per_cell, int num_workers, Observer& observer,
                            const std::atomic<bool>& stop) {
  const SessionInputs inputs = LoadSessionInputs(session.config, FieldUse::kNow, session.folder);
  CheckSameSession(session, session.config, MakePlan(session.config, inputs));
  const std::vector<TrialRecord> trials = ChooseTrials(session.records, trials_per_cell);
  if (trials.empty()) {
    throw Error(ErrorKind::kUsage, "the session in \"" + folder.string() +
                                       "\" has no finished trial; graspbench run --resume --out " +
                                       folder.string() + " runs them");
  }
  NumericsCheck check;
  for (const NumericsVariant& variant : ListNumericsVariants(session.config.sim)) {
    const std::vector<TrialRecord> covered = FindCovered(trials, variant, inputs);
    const std::vector<TrialResult> results =
        RerunTrials(covered, variant, session.config, inputs, num_workers, observer, stop);
    for (size_t i = 0; i < covered.size(); ++i) {
      check.comparisons.push_back({variant.id, covered[i], results[i]});
    }
    check.summaries.push_back(SummariseNumerics(variant.id, check.comparisons));
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
