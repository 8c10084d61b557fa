#pragma once
/** @file
What a study keeps of the hand's opening in one trial. */

#include <vector>

#include "human_study/events/trial_analysis.h"
#include "human_study/study/run/run_study.h"

namespace graspbench {

/** Every measure of opening, in the order of HandOpeningList(), with all digits and without each. */
std::vector<OpeningValues> CalcOpenings(FilteredTrial& trial, const TrialAnalysis& analysis,
                                        const AnalysisOptions& options);

/** StudyTrial::opening_course. */
std::vector<double> SampleOpening(const TrialAnalysis& analysis);

}  // namespace graspbench
