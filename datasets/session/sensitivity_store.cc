#include "datasets/session/sensitivity_store.h"

#include <map>
#include <set>
#include <string_view>
#include <vector>

#include "datasets/journal/checked_line.h"

namespace graspbench {
namespace {

constexpr char kSensitivityFolder[] = "sensitivity";

/** False: the line's trial has other measures already. @throws Json::exception, Error(kFormat). */
bool AddLine(std::string_view line, const std::set<std::string>& known_ids, SensitivityData& data) {
  const Json json = ParseCheckedLine(line);
  const auto setting = json.at("setting").get<std::string>();
  const auto id = json.at("trial_id").get<std::string>();
  if (known_ids.count(id) == 0) {
    throw Error(ErrorKind::kFormat, "trial " + id + " is not finished");
  }
  TrialMeasures measures;
  ReadRecord(json.at("measures"), measures);
  const auto [known, is_new] = data[setting].emplace(id, measures);
  return is_new || RecordToJson(known->second) == RecordToJson(measures);
}

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
void AddConditions(const Session& session, const std::filesystem::path& folder,
                   SensitivityData& data, Diagnostics& conflicts) {
  std::map<std::string, std::string> ids;
  for (const TrialRecord& record : session.records) {
    ids.emplace(NameDraw(record.plan), record.plan.id);
  }
  const Session varied = LoadSession(folder, OnDamage::kAccept, RecordParts::kBrief);
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
        folder.filename().string(), 0,
        "trial " + id->second + " has two different results under " + *record.plan.condition);
  }
}

}  // namespace

SensitivityData LoadSensitivity(const Session& session, Diagnostics& findings) {
  SensitivityData data;
  const std::vector<std::filesystem::path> journals =
      session.folder.empty() ? std::vector<std::filesystem::path>()
                             : ListJournals(session.folder, kSensitivityFolder);
  std::set<std::string> ids;
  for (const TrialRecord& record : session.records) ids.insert(record.plan.id);
  Diagnostics conflicts;
  for (const std::filesystem::path& path : journals) {
    const std::string file = std::string(kSensitivityFolder) + "/" + path.filename().string();
    ForEachLineOfFile(path, [&](const FileLine& line) {
      if (line.text.empty()) return;
      if (!line.is_whole) {
        findings.Warn(file, line.number,
                      "the last line was not finished; its trial counts as not run");
        return;
      }
      try {
        if (!AddLine(line.text, ids, data)) {
          conflicts.Fail(file, line.number, "a trial has two different results under one setting");
        }
      } catch (const std::exception& e) {  // of the JSON library, or an Error of a value
        findings.Warn(file, line.number,
                      std::string("skipped: ") + e.what() + "; it counts as not run");
      }
    });
  }
  for (const std::string& store : ListMatches(session.folder, {"sensitivity/*"})) {
    if (HasSession(session.folder / store)) {
      AddConditions(session, session.folder / store, data, conflicts);
    }
  }
  conflicts.ThrowIfErrors(ErrorKind::kFormat,
                          "two versions of the program have run the session's sensitivity or a "
                          "file was edited; move the folder \"sensitivity\" elsewhere and run "
                          "graspbench sensitivity again");
  return data;
}

}  // namespace graspbench
