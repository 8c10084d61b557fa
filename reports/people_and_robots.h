#pragma once
/** @file
People and robots in one picture, for a campaign's page and a study's: when each digit touches under
each schedule on the same objects, and what a schedule costs
(datasets/analysis/schedules/schedule_comparison.h). */

#include "datasets/analysis/schedules/schedule_comparison.h"
#include "reports/page/layout.h"
#include "reports/page/models.h"

namespace graspbench {

/** A figure for each hand, object and grasp, the first ones unfolded; a table of costs; what is not
compared, with the reason. */
Html DrawPeopleAndRobots(const ScheduleComparison& comparison, const SessionModels& models);

/** The comparisons one after the other; of none the command that makes one.
@param session  as a person names it. */
Html DrawSchedules(const std::vector<ScheduleComparison>& comparisons, const SessionModels& models,
                   const std::string& session);

}  // namespace graspbench
