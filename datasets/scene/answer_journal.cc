#include "datasets/scene/answer_journal.h"

#include "datasets/journal/checked_line.h"

namespace graspbench {

std::string EvaluationRecord::Format(const EvaluationRecord& record) {
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
  if (record.search) json["search"] = *record.search;
  return FormatCheckedLine(json);
}

EvaluationRecord EvaluationRecord::Parse(std::string_view line) {
  return ReadCheckedLine(line, [](const Json& json) {
    EvaluationRecord record;
    record.request = IntFrom(json.at("request"));
    if (json.contains("search")) record.search = json.at("search").get<std::string>();
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
  });
}

}  // namespace graspbench
