#include "datasets/session/sensitivity_store.h"

#include <map>
#include <set>
#include <vector>

#include "datasets/journal/read_journal.h"
#include "datasets/session/judgement_store.h"
#include "datasets/session/session_experiments.h"

namespace graspbench {
namespace {

constexpr char kSensitivityFolder[] = "sensitivity";

}  // namespace

TrialMeasures MakeTrialMeasures(const TrialResult& result) {
  TrialMeasures measures;
  measures.outcome = result.outcome;
  if (IsNumericalFailure(result.outcome)) return measures;
  if (!result.timing.contact_before_start) {
    measures.gct = result.timing.gct;
    measures.gft = result.timing.gft;
    measures.gft_ratio = result.timing.gft_ratio;
    measures.got_ratio = result.timing.got_ratio;
  }
  measures.sigma = result.stability.sigma;
  return measures;
}

namespace {

/** @returns whether all trials that are known have the same measures. */
void AddConditions(const Session& session, const Session& varied, SensitivityData& data,
                   Diagnostics& conflicts) {
  std::map<std::string, std::string> ids;
  for (const TrialRecord& record : session.records) {
    ids.emplace(NameDraw(record.plan), record.plan.id);
  }
  std::map<std::string, std::string> settings;
  for (const Condition& condition : varied.config.conditions) {
    settings.emplace(condition.name, condition.settings.at(0));
  }
  for (const TrialRecord& record : varied.records) {
    const auto id = ids.find(NameDraw(record.plan));
    if (!record.plan.condition || id == ids.end()) continue;
    const TrialMeasures measures = MakeTrialMeasures(record.result);
    const auto [known, is_new] =
        data[settings.at(*record.plan.condition)].emplace(id->second, measures);
    if (is_new || RecordToJson(known->second) == RecordToJson(measures)) continue;
    conflicts.Fail(
        varied.folder.filename().string(), 0,
        "trial " + id->second + " has two different results under " + *record.plan.condition);
  }
}

}  // namespace

SensitivityData LoadSensitivity(const Session& session) {
  SensitivityData data;
  Diagnostics conflicts;
  for (const Session& varied : LoadExperiments(session, kSensitivityFolder)) {
    AddConditions(session, varied, data, conflicts);
  }
  conflicts.ThrowIfErrors(ErrorKind::kFormat,
                          "two versions of the program have run the session's sensitivity or a "
                          "file was edited; move the folder \"sensitivity\" elsewhere and run "
                          "graspbench sensitivity again");
  return data;
}

}  // namespace graspbench
