#pragma once
/** @file
People beside the schedules of a robot's grasps, as text for the terminal. */

#include <string>

#include "datasets/analysis/schedules/schedule_comparison.h"

namespace graspbench {

/** What PrepareSchedules made of a session. */
struct SchedulePlan {
  PeopleFile people;
  const Session* session = nullptr;  ///< of the schedules
};
/** One row an object, hand and schedule: how many trials, or why there is no such schedule. */
std::string FormatSchedulePlan(const SchedulePlan& plan);
Json ToJson(const SchedulePlan& plan);

/** One row an object, hand and schedule, then why something is not compared. */
std::string FormatSchedules(const ScheduleComparison& comparison);

}  // namespace graspbench
