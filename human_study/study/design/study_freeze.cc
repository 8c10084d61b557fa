#include "human_study/study/design/study_freeze.h"

#include <map>
#include <optional>
#include <set>

#include "core/base/config.h"
#include "core/base/files/files.h"
#include "core/base/hash.h"
#include "core/base/text/delimited_text.h"
#include "core/base/text/text.h"
#include "core/base/version.h"
#include "human_study/study/design/study_config.h"

namespace graspbench {
namespace fs = std::filesystem;

namespace {

constexpr const char* kWhat = "graspbench: choices of a study, frozen";

using TextOfChoice = std::map<std::string, std::string>;

/** By what it is called in study.yaml ("contact.cutoff_hz"), the text of every value in `json`. */
void ListTexts(const Json& json, const std::string& name, TextOfChoice& texts) {
  const std::string before = name.empty() ? "" : name + ".";
  if (json.empty()) {
    texts[name] = "null";
  } else if (json.is_object()) {
    for (const auto& [key, value] : json.items()) ListTexts(value, before + key, texts);
  } else if (json.is_array()) {
    for (size_t i = 0; i < json.size(); ++i) ListTexts(json[i], before + std::to_string(i), texts);
  } else {
    texts[name] = FormatJson(json);
  }
}

/** Every setting that is a choice of the analysis. */
Json ListChoices(const StudyConfig& config) {
  Json settings = ConfigToJson(config);
  settings.erase("name");
  settings.erase("robot");
  return settings;
}

/** Hashes of the tables that hold choices; null for one that is not named or not there. */
Json HashTables(const StudyConfig& config, const fs::path& folder) {
  Json tables = Json::object();
  for (const auto& [key, name] : {std::pair("objects", config.objects),
                                  {"hypotheses", config.hypotheses},
                                  {"recording.mapping", config.recording.mapping}}) {
    tables[key] = nullptr;
    if (!name.empty() && fs::exists(folder / name)) {
      tables[key] = CalcSha256(ReadFile(folder / name));
    }
  }
  return tables;
}

/** Empty without trials.csv. */
std::optional<DataTable> ReadTrials(const fs::path& trials, Diagnostics& problems) {
  if (!fs::exists(trials)) return std::nullopt;
  DataTable table(ReadFile(trials), trials.string(), problems);
  problems.ThrowIfErrors(ErrorKind::kFormat, "the study cannot be frozen");
  return table;
}

/** What each row says of its trial, by "<participant>-<trial>". */
Json ListRows(const StudyConfig& config, const DataTable& table) {
  std::vector<std::string> columns = {"file",  "table_trial", "object", "start_s",
                                      "end_s", "remove",      "hand"};
  columns.insert(columns.end(), config.factors.begin(), config.factors.end());
  columns.insert(columns.end(), config.groups.begin(), config.groups.end());
  if (!config.session.empty()) columns.push_back(config.session);
  Json rows = Json::object();
  std::map<std::string, int> counts;
  for (size_t row = 0; row < table.num_rows(); ++row) {
    const std::string& participant = table.Text(row, "participant");
    const int count = ++counts[participant];
    const std::string& trial = table.Text(row, "trial");
    Json cells = Json::object();
    for (const std::string& column : columns) {
      if (table.Has(column)) cells[column] = table.Text(row, column);
    }
    rows[participant + "-" + (trial.empty() ? std::to_string(count) : trial)] = cells;
  }
  return rows;
}

/** Recordings that trials.csv names and that are there. */
int CountRecordings(const DataTable& table, const fs::path& recordings) {
  std::set<std::string> present;
  for (size_t row = 0; row < table.num_rows(); ++row) {
    const std::string& file = table.Text(row, "file");
    if (!file.empty() && fs::exists(recordings / file)) present.insert(file);
  }
  return static_cast<int>(present.size());
}

std::string HashChoices(const Json& choices) { return CalcSha256(FormatJson(choices)); }

[[noreturn]] void FailFreeze(const std::string& name, const std::string& text) {
  throw Error(ErrorKind::kFormat, name + ": " + text);
}

void CompareSettings(const Json& frozen, const Json& used, FreezeCheck& check) {
  TextOfChoice before, now;
  ListTexts(frozen, "", before);
  ListTexts(used, "", now);
  for (const auto& [name, text] : before) now.try_emplace(name, "nothing");
  for (const auto& [name, text] : now) {
    const std::string& old = before.try_emplace(name, "nothing").first->second;
    if (old != text) check.deviations.push_back({name, old, text});
  }
}

/** One deviation for all rows that are gone, and one for each column that changed. */
void CompareRows(const Json& frozen, const Json& used, FreezeCheck& check) {
  std::vector<std::string> gone;
  struct Change {
    std::string trial, before, now;
    int count = 0;
  };
  std::map<std::string, Change> changes;  // by column, the first with the number of all
  for (const auto& [trial, cells] : frozen.items()) {
    if (!used.contains(trial)) {
      gone.push_back(trial);
      continue;
    }
    const Json &before = cells, &now = used[trial];
    std::set<std::string> columns;
    for (const Json* row : {&before, &now}) {
      for (const auto& [column, text] : row->items()) columns.insert(column);
    }
    for (const std::string& column : columns) {
      const std::string a = before.value(column, ""), b = now.value(column, "");
      if (a == b) continue;
      Change& change = changes[column];
      if (change.count++ == 0) change = {trial, Json(a).dump(), Json(b).dump(), 1};
    }
  }
  const auto more = [](size_t count) {
    return count > 1 ? " and " + std::to_string(count - 1) + " more" : std::string();
  };
  if (!gone.empty()) {
    check.deviations.push_back(
        {"trials.csv", "trial " + gone.front() + more(gone.size()), "no such row"});
  }
  for (const auto& [column, change] : changes) {
    check.deviations.push_back({"trials.csv, " + column + " of trial " + change.trial +
                                    more(static_cast<size_t>(change.count)),
                                change.before, change.now});
  }
}

}  // namespace

fs::path FindFreezePath(const fs::path& study_file) {
  return study_file.parent_path() / (study_file.stem().string() + ".freeze.json");
}

std::string MakeFreeze(const fs::path& study_file, const fs::path& recordings) {
  Diagnostics problems;
  const StudyConfig config = ParseStudyConfig(ReadFile(study_file), study_file.string(), problems);
  problems.ThrowIfErrors(ErrorKind::kFormat, "the study cannot be frozen");
  const fs::path folder = study_file.parent_path();
  const std::optional<DataTable> trials = ReadTrials(folder / config.trials, problems);
  Json choices = {
      {"what", kWhat},
      {"program", program_version()},
      {"settings", ListChoices(config)},
      {"tables", HashTables(config, folder)},
      {"trials", trials ? ListRows(config, *trials) : Json::object()},
      {"num_recordings",
       trials ? CountRecordings(*trials, recordings.empty() ? folder : recordings) : 0}};
  choices["sha256"] = HashChoices(choices);
  return FormatJson(choices, 2) + "\n";
}

FreezeCheck CompareWithFreeze(const std::string& text, const std::string& name,
                              const Study& study) {
  Json frozen = Json::try_parse(text);
  if (!frozen.is_object() || frozen.value("what", Json()) != kWhat ||
      !frozen.value("sha256", Json()).is_string()) {
    FailFreeze(name,
               "this is no file of \"graspbench study freeze\"; remove it, or bring the "
               "frozen one back");
  }
  FreezeCheck check;
  check.hash = frozen["sha256"].get<std::string>();
  frozen.erase("sha256");
  if (HashChoices(frozen) != check.hash) {
    FailFreeze(name,
               "the frozen choices were changed since they were written (their SHA-256 does "
               "not fit); bring the frozen file back, or remove it and say so");
  }
  if (!frozen.value("settings", Json()).is_object() ||
      !frozen.value("tables", Json()).is_object() ||
      !frozen.value("num_recordings", Json()).is_number_integer()) {
    FailFreeze(name, "settings, tables or num_recordings are missing; freeze again");
  }
  check.num_recordings = frozen["num_recordings"].get<int>();
  if (frozen.value("program", Json()) != program_version()) {
    check.deviations.push_back({"version of graspbench", frozen.value("program", Json()).dump(),
                                Json(program_version()).dump()});
  }
  CompareSettings(frozen["settings"], ListChoices(study.stated), check);
  const Json tables = HashTables(study.stated, study.folder);
  for (const auto& [key, hash] : tables.items()) {
    const Json before = frozen["tables"].value(key, Json());
    if (before == hash) continue;
    const auto show = [](const Json& table) {
      return table.is_string() ? "SHA-256 " + table.get<std::string>().substr(0, 12)
                               : std::string("no table");
    };
    check.deviations.push_back({"table " + key, show(before), show(hash)});
  }
  Diagnostics problems;
  const std::optional<DataTable> trials = ReadTrials(study.folder / study.stated.trials, problems);
  if (trials) {
    CompareRows(frozen.value("trials", Json::object()), ListRows(study.stated, *trials), check);
  }
  return check;
}

std::string DescribeFreeze(const Study& study) {
  if (!study.freeze) return "";
  const FreezeCheck& check = *study.freeze;
  const int count = static_cast<int>(check.deviations.size());
  return "Choices frozen " +
         (check.num_recordings == 0
              ? std::string("before any recording")
              : "when " + FormatCount(check.num_recordings, "recording was", "recordings were") +
                    " there already") +
         " (SHA-256 " + check.hash.substr(0, 12) +
         "): " + (count == 0 ? std::string("no deviation") : FormatCount(count, "deviation")) + ".";
}

std::vector<std::string> ListDeviations(const Study& study) {
  std::vector<std::string> lines;
  if (!study.freeze) return lines;
  for (const Deviation& deviation : study.freeze->deviations) {
    lines.push_back(deviation.what + ": frozen " + deviation.frozen + ", used " + deviation.used);
  }
  return lines;
}

}  // namespace graspbench
