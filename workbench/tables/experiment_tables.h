#pragma once
/** @file
Results of experiments on the draws of a session, as text for the terminal. Short tables are defined
in the file of their command. */

#include <string>
#include <vector>

#include "datasets/analysis/conditions/delay_summary.h"
#include "datasets/analysis/conditions/numerics_summary.h"
#include "datasets/analysis/conditions/sensitivity_summary.h"
#include "datasets/analysis/conditions/sweep_summary.h"
#include "datasets/analysis/map/map_result.h"
#include "datasets/analysis/schedules/schedule_comparison.h"
#include "datasets/analysis/simultaneity_summary.h"

namespace graspbench {

/** One row per setting and hand. */
std::string FormatSensitivityTables(const SensitivitySummary& summary);

/** A table of the variants, and one of the flips when there are any. */
std::string FormatNumericsTables(const std::vector<NumericsSummary>& summaries,
                                 const std::vector<NumericsComparison>& comparisons);

/** One row per hand and response, one column per simultaneity measure. */
std::string FormatRelations(const std::vector<SimultaneityRelation>& relations);

/** One row per condition, late digit, hand and response. */
std::string FormatDoseResponses(const std::vector<DoseResponse>& rows);

/** One row per condition, and the cost of the bisections. */
std::string FormatThresholdTables(const ThresholdSummary& summary);

/** Results of a sweep as text for the terminal: conditions, effects, and the interactions whose
interval excludes 0. */
std::string FormatSweepTables(const SweepSummary& summary);

/** Formats a simultaneity map for the terminal: the findings for each hand, then the levels. Shows
delays of the last digit only; those of the first, and all pairs of levels, are in map.csv and the
report. */
std::string FormatMap(const MapResult& result);

/** The closing schedules that PrepareSchedules made for a session, and the people they are compared
with. */
struct SchedulePlan {
  PeopleFile people;
  const Session* session = nullptr;  ///< of the schedules
};
/** One row per object, hand and schedule: the number of trials, or why there is no such
schedule. */
std::string FormatSchedulePlan(const SchedulePlan& plan);
Json ToJson(const SchedulePlan& plan);

/** One row per object, hand and schedule, then the reasons for omitted comparisons. */
std::string FormatSchedules(const ScheduleComparison& comparison);

}  // namespace graspbench
