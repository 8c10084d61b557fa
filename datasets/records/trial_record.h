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
  std::optional<Judgement> judgement = {};  ///< stored separately, see judgement_store.h
};

Json ToJson(const PlannedTrial& planned);
/** @throws Json::exception or Error(kFormat) when a key is missing or of another type. */
PlannedTrial PlannedTrialFromJson(const Json& json);

/** Parses a line of the plan. @throws Json::exception or Error(kFormat) saying what is wrong. */
PlannedTrial ParsePlannedTrial(std::string_view line);

Json ToJson(const TrialRecord& record);

/** Formats the line without its line break. Numbers have the shortest exact form, so that parsing
gives the same record. */
std::string FormatJournalLine(const TrialRecord& record);

/** @throws Error(kFormat) saying what is wrong with the line: cut off, checksum, content. */
TrialRecord ParseJournalLine(std::string_view line);

/** Formats the judgement of one trial's held grasp as a journal line, without its line break. */
std::string FormatJudgementLine(const std::string& trial_id, const Judgement& judgement);
/** @throws Error(kFormat) saying what is wrong with the line. */
Judgement ParseJudgementLine(std::string_view line);

/** Location of a record's line in a session's files. Large sessions hold only the parts of records
that summaries need in memory; exports and figures reload the complete record. */
struct LinePlace {
  int file = -1;        ///< index in RecordLines::files; -1: no such line
  int number = 0;       ///< one-based
  uintmax_t start = 0;  ///< in the file [bytes]
  size_t length = 0;    ///< without the line break [bytes]
};

struct RecordLines {
  std::filesystem::path folder;
  std::vector<std::string> files;     ///< "journal/0.jsonl", relative to the folder
  std::vector<LinePlace> trials;      ///< of all records, or of the whole plan, in order
  std::vector<LinePlace> judgements;  ///< likewise
};

/** Returns "journal/0.jsonl:12". */
std::string NameOfLine(const RecordLines& lines, const LinePlace& place);

/** @pre place.file >= 0. @throws Error(kIo) when the line can no longer be read. */
std::string ReadLine(const RecordLines& lines, const LinePlace& place);

/** Difference between a re-simulated trial and its record. */
struct FieldDifference {
  std::string field;          ///< "contacts/2/time_s"
  std::string recorded, now;  ///< as JSON; "missing" if there is no such field
};

/** Returns the first field that is not bitwise equal; none if all are equal. */
[[nodiscard]] std::optional<FieldDifference> FindFirstDifference(const TrialResult& recorded,
                                                                 const TrialResult& now);

/** As above for the whole record; compares the plan before the result. */
[[nodiscard]] std::optional<FieldDifference> FindFirstDifference(const TrialRecord& recorded,
                                                                 const TrialRecord& now);

}  // namespace graspbench
