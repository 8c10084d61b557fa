#pragma once
/** @file
Results of experiments on the draws of a session, as text for the terminal. Short tables are defined
in the file of their command. */

#include <string>
#include <vector>

#include "datasets/analysis/conditions/delay_summary.h"
#include "datasets/analysis/conditions/numerics_summary.h"
#include "datasets/analysis/conditions/sweep_summary.h"
#include "datasets/analysis/map/map_result.h"
#include "datasets/analysis/schedules/schedule_comparison.h"
#include "datasets/analysis/session_comparison.h"
#include "datasets/analysis/simultaneity_summary.h"

namespace graspbench {

/** One row per setting and hand. */
std::string FormatSensitivityTables(const SensitivitySummary& summary);

/** A table of the variants, and one of the flips when there are any. */
std::string FormatNumericsTables(const std::vector<NumericsSummary>& summaries,
                                 const std::vector<NumericsComparison>& comparisons);

/** One row a hand and response, one column a measure of simultaneity. */
std::string FormatRelations(const std::vector<SimultaneityRelation>& relations);

/** One row a condition, late digit, hand and response. */
std::string FormatDoseResponses(const std::vector<DoseResponse>& rows);

/** One row per cell, and what the bisections took. */
std::string FormatThresholdTables(const ThresholdSummary& summary);

/** One row per scale and hand; empty without any. */
std::string FormatThresholdChanges(const std::vector<ThresholdChange>& changes);

/** What a sweep found, as text for the terminal. Conditions, effects, and the interactions whose
interval excludes 0. */
std::string FormatSweepTables(const SweepSummary& summary);

/** A map of simultaneity for a terminal: what it finds of each hand, then its levels. Of the last
digit; the first's and every two levels are in map.csv and the report. */
std::string FormatMap(const MapResult& result);

/** People beside the schedules of a robot's grasps, as text for the terminal. What PrepareSchedules
made of a session. */
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
