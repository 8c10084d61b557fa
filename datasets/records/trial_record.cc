#include "datasets/records/trial_record.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "core/base/error.h"
#include "core/base/text/record_fields.h"
#include "datasets/journal/checked_line.h"

namespace graspbench {

namespace {

/** The first in the order of the fields. @param a, b  null pointers where the field is missing.
@param field  of both; empty: the whole. */
std::optional<FieldDifference> Compare(const Json* a, const Json* b, const std::string& field) {
  const auto format = [](const Json* json) { return json ? FormatJson(*json) : "missing"; };
  if (a == nullptr || b == nullptr) return FieldDifference{field, format(a), format(b)};
  if (*a == *b) return std::nullopt;
  const std::string before = field.empty() ? "" : field + "/";
  std::optional<FieldDifference> difference;
  if (a->is_array() && b->is_array()) {
    const auto find = [](const Json& json, size_t i) {
      return i < json.size() ? &json[i] : nullptr;
    };
    for (size_t i = 0; i < std::max(a->size(), b->size()) && !difference; ++i) {
      difference = Compare(find(*a, i), find(*b, i), before + std::to_string(i));
    }
    return difference;
  }
  if (a->is_object() && b->is_object()) {
    for (const Json* const json : {a, b}) {
      for (const auto& [key, value] : json->items()) {
        if (!difference) difference = Compare(a->find(key), b->find(key), before + key);
      }
    }
    return difference;
  }
  return FieldDifference{field, format(a), format(b)};
}

std::optional<FieldDifference> Compare(const Json& a, const Json& b) { return Compare(&a, &b, ""); }

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

std::optional<FieldDifference> FindFirstDifference(const TrialResult& recorded,
                                                   const TrialResult& now) {
  return Compare(ToJson(recorded), ToJson(now));
}

std::optional<FieldDifference> FindFirstDifference(const TrialRecord& recorded,
                                                   const TrialRecord& now) {
  const auto difference = Compare(ToJson(recorded.plan), ToJson(now.plan));
  return difference ? difference : FindFirstDifference(recorded.result, now.result);
}

std::string NameOfLine(const RecordLines& lines, const LinePlace& place) {
  return lines.files.at(static_cast<size_t>(place.file)) + ":" + std::to_string(place.number);
}

std::string ReadLine(const RecordLines& lines, const LinePlace& place) {
  const std::filesystem::path path = lines.folder / lines.files.at(static_cast<size_t>(place.file));
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  std::string text(place.length, '\0');
  size_t length = 0;
  ssize_t count = file < 0 ? -1 : 1;
  while (count > 0 && length < text.size()) {
    count = ::pread(file, text.data() + length, text.size() - length,
                    static_cast<off_t>(place.start + length));
    if (count > 0) length += static_cast<size_t>(count);
    if (count < 0 && errno == EINTR) count = 1;
  }
  const std::string reason = count < 0 ? std::strerror(errno) : "it has become shorter";
  if (file >= 0) ::close(file);
  if (length < text.size()) {
    throw Error(ErrorKind::kIo, "cannot read \"" + path.string() +
                                    "\":" + std::to_string(place.number) + " again: " + reason);
  }
  return text;
}

std::string FormatJudgementLine(const std::string& trial_id, const Judgement& judgement) {
  return FormatCheckedLine({{"trial_id", trial_id},
                            {"judge_version", kJudgeVersion},
                            {"judgement", RecordToJson(judgement)}});
}

Judgement ParseJudgementLine(std::string_view line) {
  return ReadCheckedLine(line, [](const Json& json) {
    Judgement judgement;
    ReadRecord(json.at("judgement"), judgement);
    return judgement;
  });
}

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

TrialRecord ParseJournalLine(std::string_view line) {
  if (std::optional<TrialRecord> record = ReadAsWritten(line)) return *std::move(record);
  return ReadCheckedLine(line, [](const Json& json) {
    return TrialRecord{PlannedTrialFromJson(json), TrialResultFromJson(json.at("result"))};
  });
}

}  // namespace graspbench
