#pragma once
/** @file
A finished trial as one line of a journal, with a checksum (checked_line.h). */

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/text/json.h"
#include "core/trial/judge/judgement.h"
#include "core/trial/trial_result.h"
#include "datasets/plan/session_plan.h"

namespace graspbench {

struct TrialRecord {
  PlannedTrial plan;
  TrialResult result;
  std::optional<Judgement> judgement = {};  ///< kept apart, see judgement_store.h
};

Json ToJson(const PlannedTrial& planned);
/** @throws Json::exception or Error(kFormat) when a key is missing or of another type. */
PlannedTrial PlannedTrialFromJson(const Json& json);

/** Of a line of the plan. @throws Json::exception or Error(kFormat), what is wrong with it. */
PlannedTrial ParsePlannedTrial(std::string_view line);

Json ToJson(const TrialRecord& record);

/** Without the line break. Numbers are written shortest-exact: reading gives the same record. */
std::string FormatJournalLine(const TrialRecord& record);

/** @throws Error(kFormat) saying what is wrong with the line: cut off, checksum, content. */
TrialRecord ParseJournalLine(std::string_view line);

/** A judgement of one trial's held grasp as a line of a journal.

Without the line break. */
std::string FormatJudgementLine(const std::string& trial_id, const Judgement& judgement);
/** @throws Error(kFormat) saying what is wrong with the line. */
Judgement ParseJudgementLine(std::string_view line);

/** Where the lines of a session's records stand in its files. A session of many trials is held in
memory only as far as summaries ask; a record is read again as a whole where an export or a picture
needs it. */
struct LinePlace {
  int file = -1;        ///< in RecordLines::files; -1: there is no such line
  int number = 0;       ///< one-based
  uintmax_t start = 0;  ///< in the file [bytes]
  size_t length = 0;    ///< without the line break [bytes]
};

struct RecordLines {
  std::filesystem::path folder;
  std::vector<std::string> files;     ///< "journal/0.jsonl", from the folder
  std::vector<LinePlace> trials;      ///< of all records, in their order; or of the whole plan
  std::vector<LinePlace> judgements;  ///< of the same
};

/** "journal/0.jsonl:12". */
std::string NameOfLine(const RecordLines& lines, const LinePlace& place);

/** @pre place.file >= 0. @throws Error(kIo) when it cannot be read any more. */
std::string ReadLine(const RecordLines& lines, const LinePlace& place);

/** A trial that was simulated again against its record. */
struct FieldDifference {
  std::string field;          ///< "contacts/2/time_s"
  std::string recorded, now;  ///< as JSON; "missing" where there is no such field
};

/** The first field of the record that is not the same to the last bit; unset: all are. */
[[nodiscard]] std::optional<FieldDifference> FindFirstDifference(const TrialResult& recorded,
                                                                 const TrialResult& now);

/** The same of the whole record; what decides the trial comes before its result. */
[[nodiscard]] std::optional<FieldDifference> FindFirstDifference(const TrialRecord& recorded,
                                                                 const TrialRecord& now);

}  // namespace graspbench
