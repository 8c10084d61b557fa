#pragma once
/** @file
People beside the schedules of a robot's grasps, as text for the terminal. */

#include <string>

#include "datasets/analysis/schedules/schedule_comparison.h"

namespace graspbench {

/** One row an object, hand and schedule, then why something is not compared. */
std::string FormatSchedules(const ScheduleComparison& comparison);

}  // namespace graspbench
