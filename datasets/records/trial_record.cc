#include "datasets/records/trial_record.h"

#include "core/base/text/record_text.h"
#include "datasets/journal/checked_line.h"

namespace graspbench {

Json ToJson(const PlannedTrial& planned) { return RecordToJson(planned); }

PlannedTrial PlannedTrialFromJson(const Json& json) {
  PlannedTrial planned;
  ReadRecord(json, planned);
  return planned;
}

Json ToJson(const TrialRecord& record) {
  Json json = ToJson(record.plan);
  json["result"] = ToJson(record.result);
  if (record.judgement) json["judgement"] = RecordToJson(*record.judgement);
  return json;
}

std::string FormatJournalLine(const TrialRecord& record) {
  GRASPBENCH_DEMAND(record.result.outcome != Outcome::kNotRun, record.plan.id);
  return FormatCheckedLine(ToJson(record));
}

PlannedTrial ParsePlannedTrial(std::string_view line) {
  JsonCursor text(line);
  PlannedTrial planned;
  ReadRecordText(text, planned);
  if (!text.has_failed() && text.rest().empty()) return planned;
  return PlannedTrialFromJson(Json::parse(line));
}

namespace {

/** None: it is not just as FormatJournalLine writes it. */
std::optional<TrialRecord> ReadAsWritten(std::string_view line) {
  JsonCursor text(FindCheckedBody(line));
  TrialRecord record;
  text.Demand("{");
  ReadFieldsText(text, record.plan);
  text.Demand(",\"result\":");
  record.result = ReadTrialResultText(text);
  if (text.has_failed() || !text.rest().empty()) return {};
  return record;
}

}  // namespace

TrialRecord ParseJournalLine(std::string_view line) {
  if (std::optional<TrialRecord> record = ReadAsWritten(line)) return *std::move(record);
  return ReadCheckedLine(line, [](const Json& json) {
    return TrialRecord{PlannedTrialFromJson(json), TrialResultFromJson(json.at("result"))};
  });
}

}  // namespace graspbench
