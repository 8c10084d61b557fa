#pragma once
/** @file
What the fuzzers do with bytes as a session's files, shared with the test that replays the cases:
anything is refused with an Error or understood and written back. */

#include <string>

#include "core/base/error.h"
#include "core/base/hash.h"
#include "datasets/records/judgement_line.h"
#include "datasets/records/trial_table.h"
#include "datasets/scene/development_store.h"
#include "datasets/scene/evaluation_journal.h"
#include "datasets/session/session_index.h"
#include "datasets/session/session_store.h"
#include "datasets/shards/worker_log.h"

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

/** What is read is written, and that is read as the same. */
template <class Parse, class Format>
void FuzzLine(const std::string& line, Parse&& parse, Format&& format) {
  try {
    const std::string written = format(parse(line));
    GRASPBENCH_DEMAND(format(parse(written)) == written, written);
  } catch (const Error&) {
  }
}

/** A line of any journal: once as it is, once with a valid checksum, so that the record behind it
is reached. */
inline void FuzzJournalLine(const std::string& text) {
  for (const std::string& line : {text, text + ",\"xxh64\":\"" + CalcHashHex(text) + "\"}"}) {
    FuzzRecordLine(line);
    FuzzLine(line, EvaluationRecord::Parse, EvaluationRecord::Format);
    FuzzLine(line, DevelopmentRecord::Parse, DevelopmentRecord::Format);
    FuzzLine(line, ParseWorkerLine,
             [](const WorkerStart& start) { return FormatWorkerLine(start); });
    FuzzLine(line, ParseJudgementLine,
             [](const Judgement& judgement) { return FormatJudgementLine("trial", judgement); });
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
