#pragma once
/** @file
What a study found, first: the main measure of each person under each condition, and the difference
between the first and the last with its interval and number of persons. */

#include "human_study/study/run/run_study.h"
#include "reports/page/html.h"

namespace graspbench {

/** Of the first factor, over the other factors' levels; without one of the first group; nothing for
a study with neither, or without values. */
Html DrawContrast(const StudyResult& result);

}  // namespace graspbench
