#include "datasets/session/sensitivity_store.h"

#include <algorithm>
#include <set>
#include <string_view>
#include <vector>

#include "core/base/config.h"
#include "core/base/files/files.h"
#include "datasets/journal/checked_line.h"

namespace graspbench {
namespace {

constexpr char kSensitivityFolder[] = "sensitivity";

/** What leaves the draws of a trial, as key or as group of keys. */
const std::vector<std::string> kComparable = {"variation", "strategy",      "sim",
                                              "model",     "imperfections", "positioning",
                                              "camera",    "touch",         "sensors"};

std::filesystem::path MakePath(const std::filesystem::path& folder, int worker) {
  MakeFolder(folder / kSensitivityFolder);
  return FindJournal(folder / kSensitivityFolder, worker, "");
}

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

std::string NormaliseSetting(const std::string& assignment, const SessionConfig& config) {
  SessionConfig changed = config;
  ApplySetting(assignment, changed);
  const size_t first = assignment.find_first_not_of(" \t");
  const std::string key = assignment.substr(first, assignment.find_first_of(" \t=", first) - first);
  const std::string group = key.substr(0, key.find('.'));
  if (std::find(kComparable.begin(), kComparable.end(), group) == kComparable.end()) {
    throw Error(ErrorKind::kUsage, "\"" + key +
                                       "\" decides which trials there are; only what leaves their "
                                       "draws can be compared pair by pair: variation.*, "
                                       "strategy.*, sim.*, model.*, imperfections.*, "
                                       "positioning, camera.*, touch, sensors.*");
  }
  if ((group == "camera" || group == "sensors") && !ToJson(changed).contains(group)) {
    throw Error(ErrorKind::kUsage,
                "\"" + key + "\" changes nothing here: the session has " +
                    (group == "camera" ? "positioning: " + config.positioning + ", not camera"
                                       : "touch: " + config.touch + ", not sensed"));
  }
  // A session that looks, varied to one that does not, leaves the settings of the camera behind.
  CheckSessionConfig(SessionConfigFromJson(ToJson(changed), assignment));
  const Json part = ConfigToJson(changed).at(group);
  const Json value = key == group ? part : part.at(key.substr(group.size() + 1));
  return key + "=" + (value.is_string() ? value.get<std::string>() : FormatJson(value));
}

SensitivityData LoadSensitivity(const Session& session, Diagnostics& findings) {
  SensitivityData data;
  const std::vector<std::filesystem::path> journals =
      session.folder.empty() ? std::vector<std::filesystem::path>()
                             : ListJournals(session.folder, kSensitivityFolder);
  if (journals.empty()) return data;
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
  conflicts.ThrowIfErrors(ErrorKind::kFormat,
                          "two versions of the program have run the session's sensitivity or a "
                          "file was edited; move the folder \"sensitivity\" elsewhere and run "
                          "graspbench sensitivity again");
  return data;
}

SensitivityWriter::SensitivityWriter(const std::filesystem::path& folder, int worker)
    : file_(MakePath(folder, worker)) {}

void SensitivityWriter::Append(const std::string& setting, const std::string& trial_id,
                               const TrialMeasures& measures) {
  file_.Append(
      FormatCheckedLine(
          {{"setting", setting}, {"trial_id", trial_id}, {"measures", RecordToJson(measures)}}) +
      "\n");
}

}  // namespace graspbench
