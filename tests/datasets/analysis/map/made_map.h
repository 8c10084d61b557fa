#pragma once
/** @file
Stored trials of a map, made up: twelve objects, every draw of every region held without delay, none
with the last digit 0.3 s late where the grip is a margin of 1.5. */

#include "datasets/plan/conditions.h"
#include "datasets/plan/map_design.h"
#include "datasets/session/session_store.h"

namespace graspbench {

inline Session MakeMapSessionResult() {
  Session session;
  SessionConfig base;
  base.hands = {"tum"};
  session.config = MakeMapSession(ListMapParts(true).front(), base);
  std::vector<Condition> conditions = session.config.conditions;
  conditions.push_back({});
  const auto levels = ListMapLevels(conditions, session.config);
  for (int object = 0; object < 12; ++object) {
    for (size_t c = 0; c < conditions.size(); ++c) {
      TrialRecord record;
      record.plan = {"id" + std::to_string(session.plan.size()),
                     "tum",
                     "<object" + std::to_string(object) + ">",
                     "g1",
                     0,
                     std::nullopt};
      if (!conditions[c].name.empty()) record.plan.condition = conditions[c].name;
      const ConditionInputs made = ApplyCondition(conditions[c], session.config);
      const bool is_lost = made.late == LateDigit::kLast && levels[c][2] == 0;
      record.result.outcome = is_lost ? Outcome::kSlippedInLiftOff : Outcome::kSuccess;
      record.result.contacts = {{"TH", true, 0.1}, {"FF", false, 0.15}, {"MF", false, 0.12}};
      record.result.closing = Displacement{0.001 + made.delay, 0.0};
      session.plan.push_back(record.plan);
      session.records.push_back(record);
    }
  }
  return session;
}

}  // namespace graspbench
