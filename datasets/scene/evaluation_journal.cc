#include "datasets/scene/evaluation_journal.h"

#include <algorithm>

#include "core/base/files/files.h"
#include "datasets/journal/checked_line.h"

namespace graspbench {
namespace fs = std::filesystem;

std::string FormatEvaluationLine(const EvaluationRecord& record) {
  Json json = {{"request", record.request}, {"stage", NameOf(record.stage)}};
  if (RowOf(kLearningStages, record.stage).has_individual) {
    Individual individual = record.individual;
    individual.fitness = CalcFitness(record.trials);
    json.update(RecordToJson(individual));
  }
  Json trials = Json::array();
  for (size_t i = 0; i < record.trials.size(); ++i) {
    Json trial = {{"trial_id", record.trial_ids[i]}};
    trial.update(ToJson(record.trials[i]));
    trials.push_back(std::move(trial));
  }
  json["trials"] = trials;
  return FormatCheckedLine(json);
}

EvaluationRecord ParseEvaluationLine(std::string_view line) {
  const Json json = ParseCheckedLine(line);
  try {
    EvaluationRecord record;
    record.request = json.contains("request") ? IntFrom(json.at("request")) : -1;
    const LearningStageRow& stage =
        RowFromName(kLearningStages, json.at("stage").get<std::string>(), "stage");
    record.stage = stage.value;
    for (const Json& trial : json.at("trials")) {
      record.trial_ids.push_back(trial.at("trial_id").get<std::string>());
      record.trials.push_back(LearningTrialFromJson(trial));
    }
    if (record.trials.empty()) throw Error(ErrorKind::kFormat, "no trials");
    if (!stage.has_individual) return record;
    ReadRecord(json, record.individual);
    record.individual.fitness = CalcFitness(record.trials);
    return record;
  } catch (const std::exception& e) {  // of the JSON library, or an Error of a value
    throw Error(ErrorKind::kFormat, std::string("it is no record of this version: ") + e.what());
  }
}

std::vector<EvaluationRecord> LoadEvaluations(const fs::path& path, Diagnostics& findings) {
  std::vector<EvaluationRecord> records;
  if (!fs::exists(path)) return records;
  ForEachLineOfFile(path, [&](const FileLine& line) {
    try {
      if (!line.is_whole) {
        throw Error(ErrorKind::kFormat, "the line was not finished when the program stopped");
      }
      records.push_back(ParseEvaluationLine(line.text));
      if (records.back().request < 0) records.back().request = line.number - 1;
    } catch (const Error& e) {
      findings.Warn(path.filename().string(), line.number,
                    std::string(e.what()) + "; it counts as not run");
    }
  });
  std::stable_sort(
      records.begin(), records.end(),
      [](const EvaluationRecord& a, const EvaluationRecord& b) { return a.request < b.request; });
  return records;
}

const EvaluationRecord* FindEvaluation(const std::vector<EvaluationRecord>& records, int request) {
  const auto found = std::lower_bound(
      records.begin(), records.end(), request,
      [](const EvaluationRecord& record, int number) { return record.request < number; });
  return found != records.end() && found->request == request ? &*found : nullptr;
}

EvaluationJournal::EvaluationJournal(const fs::path& path) : file_(path) {
  Diagnostics findings;  // verified by whoever reads the store
  stored_ = LoadEvaluations(path, findings);
  const std::string text = ReadFile(path);
  file_.Truncate(text.rfind('\n') + 1);  // npos + 1 is 0: no whole line
}

void EvaluationJournal::Append(const std::vector<EvaluationRecord>& records) {
  std::string lines;
  for (const EvaluationRecord& record : records) lines += FormatEvaluationLine(record) + "\n";
  file_.Append(lines);
}

}  // namespace graspbench
