#pragma once
/** @file
Comparison of people and robots, for the pages of a campaign and a study: when each digit touches
under each schedule on the same objects, and the cost of each schedule
(datasets/analysis/schedules/schedule_comparison.h). */

#include "datasets/analysis/schedules/schedule_comparison.h"
#include "reports/page/layout.h"
#include "reports/page/models.h"

namespace graspbench {

/** Draws a figure for each hand, object and grasp, the first ones expanded; a table of costs; and
the omitted comparisons with reasons. */
Html DrawPeopleAndRobots(const ScheduleComparison& comparison, const SessionModels& models);

/** Draws all comparisons; without any, the command that makes one. @param session  as the user
named it. */
Html DrawSchedules(const std::vector<ScheduleComparison>& comparisons, const SessionModels& models,
                   const std::string& session);

}  // namespace graspbench
