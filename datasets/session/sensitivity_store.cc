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

/** The ids of the session's trials by their draws. @param is_any_grasp  of whatever grasp: only
draws that one grasp has met. */
std::map<std::string, std::string> ListDrawIds(const Session& session, bool is_any_grasp) {
  std::map<std::string, std::string> ids;
  std::set<std::string> repeated;
  for (const PlannedTrial& planned : session.plan) {
    const std::string name = NameDraw(planned, is_any_grasp);
    if (!ids.emplace(name, planned.id).second) repeated.insert(name);
  }
  for (const std::string& name : repeated) ids.erase(name);
  return ids;
}

void AddConditions(const Session& session, const Session& varied, SensitivityData& data,
                   Diagnostics& conflicts) {
  const std::map<std::string, std::string> ids[] = {ListDrawIds(session, false),
                                                    ListDrawIds(session, true)};
  std::map<std::string, std::string> settings;
  for (const Condition& condition : varied.config.conditions) {
    const std::string& setting = condition.settings.at(0);
    settings.emplace(condition.name, setting);
    for (const PlannedTrial& planned : session.plan) {
      if (planned.trial < varied.config.trials) data[setting][planned.id];
    }
  }
  for (const TrialRecord& record : varied.records) {
    if (!record.plan.condition) continue;
    const std::string& setting = settings.at(*record.plan.condition);
    const bool is_any_grasp = setting.rfind("grasp=", 0) == 0;
    const auto id = ids[is_any_grasp].find(NameDraw(record.plan, is_any_grasp));
    if (id == ids[is_any_grasp].end()) continue;
    const TrialMeasures measures = MakeTrialMeasures(record.result);
    TrialMeasures& known = data[setting][id->second];
    if (known.outcome == Outcome::kNotRun) known = measures;
    if (RecordToJson(known) == RecordToJson(measures)) continue;
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
