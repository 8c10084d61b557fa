#pragma once
/** @file
A finished trial as one line of a journal, with a checksum (checked_line.h). */

#include <optional>
#include <string>
#include <string_view>

#include "core/base/text/json.h"
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

}  // namespace graspbench
