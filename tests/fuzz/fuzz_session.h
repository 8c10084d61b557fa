#pragma once
/** @file
What the fuzzers do with bytes as a session's files, shared with the test that replays the cases:
anything is refused with an Error or understood and written back. */

#include <string>

#include "core/base/hash.h"
#include "datasets/records/trial_record.h"
#include "datasets/records/trial_table.h"
#include "datasets/scene/answer_journal.h"
#include "datasets/scene/development_store.h"
#include "datasets/session/session_store.h"
#include "datasets/shards/worker_log.h"
#include "tests/fuzz/fuzz_target.h"

namespace graspbench {

inline void FuzzRecordLine(const std::string& line) {
  try {
    const std::vector<TrialRecord> records = {ParseJournalLine(line)};
    const std::string written = FormatJournalLine(records[0]);
    GRASPBENCH_DEMAND(FormatJournalLine(ParseJournalLine(written)) == written, written);
    const auto columns = ListTrialColumns(records);
    FormatCsv(columns, records);
  } catch (const Error&) {
  }
}

/** A line of any journal: once as it is, once with a valid checksum, so that the record behind it
is reached. */
inline void FuzzJournalLine(const std::string& text) {
  for (const std::string& line : {text, text + ",\"xxh64\":\"" + CalcHashHex(text) + "\"}"}) {
    FuzzRecordLine(line);
    FuzzRoundTrip(line, EvaluationRecord::Parse, EvaluationRecord::Format);
    FuzzRoundTrip(line, DevelopmentRecord::Parse, DevelopmentRecord::Format);
    FuzzRoundTrip(line, ParseWorkerLine,
                  [](const WorkerStart& start) { return FormatWorkerLine(start); });
    FuzzRoundTrip(line, ParseJudgementLine, [](const Judgement& judgement) {
      return FormatJudgementLine("trial", judgement);
    });
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
