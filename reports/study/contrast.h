#pragma once
/** @file
Main result of a study: the main measure of each person under each condition, and the difference
between the first and the last condition, with its interval and number of persons. */

#include <string>
#include <vector>

#include "human_study/study/run/run_study.h"
#include "reports/page/html.h"

namespace graspbench {

/** Draws the contrast of the first factor, averaged over the other factors' levels; without
factors, that of the first group. Nothing for a study with neither, or without values. */
Html DrawContrast(const StudyResult& result);

/** Draws the same difference of every tested measure as a table. */
Html DrawContrastTable(const StudyResult& result);

/** Describes the same difference of every tested measure, one sentence each: "peak opening, size
small minus size large: -33.3 mm, .." Empty for a study without factors and groups. */
std::vector<std::string> DescribeContrasts(const StudyResult& result);

}  // namespace graspbench
