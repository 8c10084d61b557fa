#pragma once
/** @file
Main result of a study: the main measure of each person under each condition, and the difference
between the first and the last condition, with its interval and number of persons. */

#include "human_study/study/run/run_study.h"
#include "reports/page/html.h"

namespace graspbench {

/** Draws the contrast of the first factor, averaged over the other factors' levels; without
factors, that of the first group. Nothing for a study with neither, or without values. */
Html DrawContrast(const StudyResult& result);

}  // namespace graspbench
