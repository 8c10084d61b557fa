#pragma once
/** @file
What the fuzzers do with bytes as a session's files, shared with the test that replays the cases:
anything is refused with an Error or understood and written back. */

#include <string>

#include "core/base/error.h"
#include "core/base/hash.h"
#include "datasets/records/trial_table.h"
#include "datasets/scene/evaluation_journal.h"
#include "datasets/session/session_index.h"
#include "datasets/session/session_store.h"

namespace graspbench {

inline void FuzzRecordLine(const std::string& line) {
  try {
    const std::vector<TrialRecord> records = {ParseJournalLine(line)};
    const std::string written = FormatJournalLine(records[0]);
    GRASPBENCH_DEMAND(FormatJournalLine(ParseJournalLine(written)) == written, written);
    const auto columns = ListTrialColumns(records);
    FormatCsv(columns, records);
    SessionIndex(columns).AddTrial(MakeCsvCells(columns, records[0]));
  } catch (const Error&) {
  }
}

inline void FuzzEvaluationLine(const std::string& line) {
  try {
    const std::string written = EvaluationRecord::Format(EvaluationRecord::Parse(line));
    GRASPBENCH_DEMAND(EvaluationRecord::Format(EvaluationRecord::Parse(written)) == written,
                      written);
  } catch (const Error&) {
  }
}

/** Once as it is, once with a valid checksum, so that the record behind it is reached. */
inline void FuzzJournalLine(const std::string& text) {
  for (const std::string& line : {text, text + ",\"xxh64\":\"" + CalcHashHex(text) + "\"}"}) {
    FuzzRecordLine(line);
    FuzzEvaluationLine(line);
  }
}

inline void FuzzSessionYaml(const std::string& text) {
  for (const char* file : {"fuzz.yaml", "fuzz.json"}) {
    try {
      const Json frozen = ToJson(ParseSessionConfig(text, file));
      GRASPBENCH_DEMAND(FormatJson(ToJson(SessionConfigFromJson(frozen))) == FormatJson(frozen),
                        FormatJson(frozen));
    } catch (const Error&) {
    }
  }
  try {
    SessionConfig config;
    ApplySetting(text, config);
  } catch (const Error&) {
  }
}

}  // namespace graspbench
