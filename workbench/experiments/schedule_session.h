#pragma once
/** @file
The schedules of a session's grasps on its own draws (datasets/analysis/schedules/
schedule_comparison.h): a session of its own in the folder of the first, `schedules/HASH`, whose
grasps are those of the first on each object, one for each schedule, as grasp files that differ in
their closing alone; and its grip thresholds below it. So it is run, stopped, continued, judged,
verified and reported like any other.

A closing is found by trials without variation (core/trial/digit_delays.h). Where its lags come out
wrong by more than kMostLagError of the natural closing time there is no such schedule. */

#include <string>
#include <vector>

#include "datasets/analysis/schedules/schedule_comparison.h"
#include "workbench/experiments/session_experiment.h"

namespace graspbench {

inline constexpr double kMostLagError = 0.02;

struct People {
  std::string study;                  ///< as a person gave it; empty: none
  std::vector<TrialTouches> touches;  ///< of its included trials
};

/** Makes the folder, or finds it. @throws Error(kUsage) for a session with conditions or of
schedules itself, for one whose grasps have no second schedule, and for a study that has none of its
objects or digits; as PrepareExperiment. */
PreparedSession PrepareSchedules(const ExperimentRequest& request, const People& people);

}  // namespace graspbench
