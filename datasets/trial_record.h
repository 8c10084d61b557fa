#pragma once
/** @file
A finished trial as one line of text, safe against torn and damaged bytes.

    {"trial_id":"..","hand":"tum",..,"result":{..},"xxh64":"0123456789abcdef"}

The last member is the checksum: XXH64 of all bytes of the line before `,"xxh64"`. So a journal is
JSON Lines to every other program, and a flipped bit is found before the line is parsed. */

#include <string>
#include <string_view>

#include "core/base/json.h"
#include "core/sim/trial.h"
#include "datasets/session_plan.h"

namespace graspbench {

struct TrialRecord {
  PlannedTrial plan;
  TrialResult result;
};

Json ToJson(const PlannedTrial& planned);
/** @throws Json::exception or Error(kFormat) when a key is missing or of another type. */
PlannedTrial PlannedTrialFromJson(const Json& json);

Json ToJson(const TrialRecord& record);

/** Without the line break. Numbers are written shortest-exact: reading gives the same record. */
std::string FormatJournalLine(const TrialRecord& record);

/** @throws Error(kFormat) saying what is wrong with the line: cut off, checksum, content. */
TrialRecord ParseJournalLine(std::string_view line);

}  // namespace graspbench
